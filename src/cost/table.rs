//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-129, 0, 0, 9559, 4, 0],                // any sweeps
    [31, 0, 0, 27306, -1, 0],                // a sweep
    [24134, 6413, 1037, 22749, 13472, 0],    // a stored vector
    [3913, 779, 552, 0, 0, 0],               // a pair of them
    [1532, 390, 274, 0, 0, 0],               // a vector and iteration
    [2011, 2490, -32, 0, 0, 0],              // translations
    [1377, 890, 11, 0, 0, 0],                // translations, a vector
    [1926, 395, 8, 0, 0, 0],                 // translations, an iteration
    [2103, 1452, -35, 0, 0, 0],              // colliders, a vector
    [1505, 2721, -568, 0, 0, 0],             // colliders, an iteration
    [303, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11741, 16814, -97, 0, 0, 0],           // a collider
    [13946, 0, 0, 0, 0, 0],                  // a pin
    [-3662, 1175, 272, 22419, 13530, 0],     // pins or colliders that move
    [43, 1126, -15, 22207, 13471, 0],        // newmark
    [-2775, 485, -13, 0, 0, 0],              // forces
    [11602, 4924, 6, 22601, 13467, 0],       // start from velocity
    [11361, 4972, 6, 22600, 13467, 0],       // start from velocity and force
    [13725, 4545, 265, 22609, 13468, 0],     // start from rest
    [-7714, -3206, 254, 0, 0, 0],            // a past velocity
    [-24492, -9615, 764, 0, 0, 0],           // rotations
    [-13973, 46, -7, 0, 0, 0],               // held by pins
    [26233, 1805, 1220, 0, 0, 0],            // coarse: an application more
    [2237, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21610, 0, 0, 0, 0, 0],                  // coarse: its square
    [4581, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33087, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111638, 0, 0, 0, 0, 0],                 // coarse: a product
    [12266, 0, 0, 0, 0, 0],                  // coarse: a sum
    [12234, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3357, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [17952, 3203, 515, 58387, 13125, 0],     // identity: step
    [37262, 12559, 929, 101303, 44986, 0],   // identity: step with colliders
    [11353, 1757, 829, 22289, 13471, 0],     // identity: iteration
    [18048, 3235, 515, 58387, 13125, 0],     // mass: step
    [37358, 12591, 929, 101303, 44986, 0],   // mass: step with colliders
    [11353, 1757, 829, 22289, 13471, 0],     // mass: iteration
    [19080, 4338, 520, 73394, 25018, 0],     // jacobi: step
    [27395, 13897, 855, 100853, 44980, 0],   // jacobi: step with colliders
    [11794, 1751, 829, 22322, 13471, 0],     // jacobi: iteration
    [18742, 5425, 515, 79440, 31510, 0],     // block-jacobi: step
    [37304, 14620, 928, 101315, 44988, 0],   // block-jacobi: step with colliders
    [11359, 1758, 829, 22284, 13471, 0],     // block-jacobi: iteration
    [17185, 8011, 358, 72981, 31511, 0],     // warped: step
    [35292, 16286, 933, 115981, 63367, 0],   // warped: step with colliders
    [13711, 5072, 65, 18373, 13472, 1613],   // warped: iteration
    [17166, 8012, 358, 72977, 31511, 0],     // warped-half: step
    [35350, 16281, 933, 115994, 63367, 0],   // warped-half: step with colliders
    [12387, 6247, 827, 22292, 13472, 1983],  // warped-half: iteration
    [15736, 2409, 330, 58329, 13127, 0],     // laplacian: step
    [33824, 10685, 906, 101325, 44983, 0],   // laplacian: step with colliders
    [14242, 3399, -168, 17174, 13472, 1288], // laplacian: iteration
    [15734, 2409, 330, 58329, 13127, 0],     // laplacian-half: step
    [33832, 10685, 906, 101327, 44983, 0],   // laplacian-half: step with colliders
    [14104, 3521, -89, 17580, 13472, 1326],  // laplacian-half: iteration
    [38910, 21396, 417, 85307, 31462, 0],    // two-level: step
    [57925, 30573, 838, 107212, 44928, 0],   // two-level: step with colliders
    [14364, 3895, 834, 22336, 13470, 0],     // two-level: iteration
    [-8613, 2226, 73, 0, 0, 0],              // a sphere
    [-3549, 5022, 145, 0, 0, 0],             // a capsule
    [-3511, 12861, 155, 0, 0, 0],            // a box
    [-3510, 13181, 156, 0, 0, 0],            // a height field
    [10015, 19332, -116, 0, 0, 0],           // a frame
    [1084, 0, 0, 71251, 14404, 0],           // plastic flow
    [6048, 0, 0, 230728, 510, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [32300, 3058, 2436, 18424, 13624, 0],    // couplings: step
    [-10541, 1017, 1320, 17464, 19401, 0],   // couplings: diagonal where none was
    [13835, -1140, -1358, 8940, 8425, 0],    // couplings: diagonal for jacobi
    [43383, 1276, 2665, -3020, -355, 0],     // couplings: beside colliders
    [-101808, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [994, 41, -387, 0, 0, 0],                // couplings: an iteration
    [3918, -22, 1463, 0, 0, 0],              // couplings: an iteration with a factor
    [2378, 477, -2103, 4872, 726, -336],     // couplings: an iteration with half a factor
    [134087, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46061, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4881, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [0, 0, 0, 0, 0, 0],                      // couplings: a slot, a switch
    [0, 0, 0, 0, 0, 0],                      // couplings: a slot, a switch of a vector
    [45549, 0, 0, 0, 0, 0],                  // couplings: a link
    [3624, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [10865, 0, 0, 0, 0, 0],                  // couplings: a part
    [893, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [45913, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5601, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [147846, 3475, 2115, 0, 0, 0],           // islands
    [46005, 984, -3248, 0, 0, 0],            // islands, a vector
    [20787, 431, -151, 0, 0, 0],             // islands, an iteration
    [4583, 0, 0, 0, 0, 0],                   // islands: a part
    [1148, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-172, 0, 0, 9495, -4, 0],               // any sweeps
    [87, 0, 0, 9836, 6, 0],                  // a sweep
    [26426, 3997, 1199, 10158, 11414, 0],    // a stored vector
    [2582, 384, 381, 0, 0, 0],               // a pair of them
    [959, 191, 183, 0, 0, 0],                // a vector and iteration
    [3890, 1832, 55, 0, 0, 0],               // translations
    [1757, 542, 44, 0, 0, 0],                // translations, a vector
    [1960, 229, 26, 0, 0, 0],                // translations, an iteration
    [2003, 795, 56, 0, 0, 0],                // colliders, a vector
    [3603, 2579, -67, 0, 0, 0],              // colliders, an iteration
    [-931, -791, -224, 0, 0, 0],             // colliders, an iteration with a factor
    [-11601, 17514, -38, 0, 0, 0],           // a collider
    [13343, 0, 0, 0, 0, 0],                  // a pin
    [-2582, 847, 336, 10233, 11549, 0],      // pins or colliders that move
    [2060, 1129, -61, 10066, 11430, 0],      // newmark
    [-1801, 360, -16, 0, 0, 0],              // forces
    [16366, 3621, 367, 10173, 11443, 0],     // start from velocity
    [16000, 3781, 367, 10173, 11442, 0],     // start from velocity and force
    [17304, 3063, 539, 10144, 11431, 0],     // start from rest
    [-12099, -2110, -117, 0, 0, 0],          // a past velocity
    [-39059, -5712, -506, 0, 0, 0],          // rotations
    [-13356, 35, -22, 0, 0, 0],              // held by pins
    [25306, 1969, 1026, 0, 0, 0],            // coarse: an application more
    [-19161, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34850, 0, 0, 0, 0, 0],                  // coarse: its square
    [862, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29136, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42745, 0, 0, 0, 0, 0],                  // coarse: a product
    [10548, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16436, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26748, 2924, -70, 22772, 20840, 0],     // identity: step
    [52139, 10657, 922, 42557, 43541, 0],    // identity: step with colliders
    [10816, 1087, 669, 10134, 11410, 0],     // identity: iteration
    [26748, 2988, -71, 22772, 20840, 0],     // mass: step
    [52140, 10721, 922, 42557, 43541, 0],    // mass: step with colliders
    [10816, 1087, 669, 10134, 11410, 0],     // mass: iteration
    [27856, 3923, -77, 28927, 27297, 0],     // jacobi: step
    [45078, 11691, 897, 42679, 43493, 0],    // jacobi: step with colliders
    [11080, 1093, 674, 10133, 11413, 0],     // jacobi: iteration
    [27402, 5409, -74, 32210, 32172, 0],     // block-jacobi: step
    [52122, 13010, 921, 42556, 43540, 0],    // block-jacobi: step with colliders
    [10852, 1086, 670, 10135, 11409, 0],     // block-jacobi: iteration
    [28199, 3505, 5214, 31119, 32204, 0],    // warped: step
    [49007, 10326, 6021, 50600, 54915, 0],   // warped: step with colliders
    [17513, 4836, 1318, 9857, 11405, 1141],  // warped: iteration
    [28196, 3505, 5214, 31118, 32203, 0],    // warped-half: step
    [49018, 10325, 6022, 50603, 54915, 0],   // warped-half: step with colliders
    [16253, 5942, 2057, 13653, 11405, 1497], // warped-half: iteration
    [24311, 2540, -305, 22718, 20840, 0],    // laplacian: step
    [45109, 9362, 501, 42197, 43548, 0],     // laplacian: step with colliders
    [13884, 3176, 438, 8201, 11406, 842],    // laplacian: iteration
    [24311, 2540, -305, 22718, 20840, 0],    // laplacian-half: step
    [45109, 9362, 501, 42198, 43548, 0],     // laplacian-half: step with colliders
    [13699, 3312, 548, 8762, 11406, 890],    // laplacian-half: iteration
    [46802, 22951, -179, 38522, 32101, 0],   // two-level: step
    [72034, 30508, 840, 48959, 43494, 0],    // two-level: step with colliders
    [10304, 3320, 669, 10184, 11394, 0],     // two-level: iteration
    [-7668, 2185, -17, 0, 0, 0],             // a sphere
    [-8923, 4492, -632, 0, 0, 0],            // a capsule
    [-8876, 11292, -627, 0, 0, 0],           // a box
    [-8875, 11532, -627, 0, 0, 0],           // a height field
    [11374, 33544, 207, 0, 0, 0],            // a frame
    [1659, 0, 0, 23999, 12027, 0],           // plastic flow
    [5302, 0, 0, 43495, 5233, 0],            // fracture
    [513, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-83718, 7701, 9995, -5499, 1256, 0],    // couplings: step
    [12607, -769, -1146, 12276, 14002, 0],   // couplings: diagonal where none was
    [34812, -2713, -3030, 11420, 10088, 0],  // couplings: diagonal for jacobi
    [46020, -772, 1627, 2247, 4423, 0],      // couplings: beside colliders
    [-100966, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [671, 26, -145, 0, 0, 0],                // couplings: an iteration
    [-564, 36, -295, 0, 0, 0],               // couplings: an iteration with a factor
    [-30, 106, -2363, 2925, 20, -197],       // couplings: an iteration with half a factor
    [122959, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54716, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4756, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [0, 0, 0, 0, 0, 0],                      // couplings: a slot, a switch
    [0, 0, 0, 0, 0, 0],                      // couplings: a slot, a switch of a vector
    [37887, 0, 0, 0, 0, 0],                  // couplings: a link
    [3076, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [-2141, 0, 0, 0, 0, 0],                  // couplings: a part
    [649, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [58599, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [6289, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [40281, 2585, -361, 0, 0, 0],            // islands
    [17371, 541, -2338, 0, 0, 0],            // islands, a vector
    [5709, 262, 81, 0, 0, 0],                // islands, an iteration
    [4473, 0, 0, 0, 0, 0],                   // islands: a part
    [666, 0, 0, 0, 0, 0],                    // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-51, 0, 0, 7509, 14, 0],               // any sweeps
    [62, 0, 0, 6548, 2, 0],                 // a sweep
    [23998, 2994, 1670, 8164, 9696, 0],     // a stored vector
    [2051, 297, 483, 0, 0, 0],              // a pair of them
    [842, 148, 236, 0, 0, 0],               // a vector and iteration
    [5602, 1107, 437, 0, 0, 0],             // translations
    [2476, 430, 210, 0, 0, 0],              // translations, a vector
    [1941, 179, 111, 0, 0, 0],              // translations, an iteration
    [3226, 537, 348, 0, 0, 0],              // colliders, a vector
    [6593, 1677, 590, 0, 0, 0],             // colliders, an iteration
    [-1831, -396, -378, 0, 0, 0],           // colliders, an iteration with a factor
    [-5859, 13937, 113, 0, 0, 0],           // a collider
    [8401, 0, 0, 0, 0, 0],                  // a pin
    [211, 511, 666, 7733, 9782, 0],         // pins or colliders that move
    [3092, 838, 165, 7871, 9704, 0],        // newmark
    [-168, 155, 135, 0, 0, 0],              // forces
    [17203, 2570, 895, 7964, 9714, 0],      // start from velocity
    [16979, 2618, 895, 7964, 9714, 0],      // start from velocity and force
    [18120, 2031, 1121, 7974, 9709, 0],     // start from rest
    [-11633, -1545, -270, 0, 0, 0],         // a past velocity
    [-36078, -4557, -830, 0, 0, 0],         // rotations
    [-7858, 17, -2, 0, 0, 0],               // held by pins
    [15039, 1779, 876, 0, 0, 0],            // coarse: an application more
    [-5770, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22436, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32784, 0, 0, 0, 0, 0],                 // coarse: a product
    [7475, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13780, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22601, 2213, 1173, 16381, 18012, 0],   // identity: step
    [51103, 8107, 2705, 33535, 37428, 0],   // identity: step with colliders
    [11799, 529, 1101, 8221, 9696, 0],      // identity: iteration
    [22632, 2261, 1172, 16381, 18012, 0],   // mass: step
    [51137, 8155, 2705, 33535, 37428, 0],   // mass: step with colliders
    [11799, 529, 1101, 8222, 9696, 0],      // mass: iteration
    [24760, 2839, 1266, 21514, 22909, 0],   // jacobi: step
    [53973, 8268, 2957, 34883, 37394, 0],   // jacobi: step with colliders
    [11674, 554, 1100, 8163, 9698, 0],      // jacobi: iteration
    [23179, 3844, 1172, 23787, 27777, 0],   // block-jacobi: step
    [50945, 9606, 2703, 33507, 37428, 0],   // block-jacobi: step with colliders
    [11897, 522, 1102, 8238, 9696, 0],      // block-jacobi: iteration
    [30732, 2399, 2176, 22336, 27887, 0],   // warped: step
    [50972, 8100, 3155, 38612, 47316, 0],   // warped: step with colliders
    [20848, 2898, 2296, 9035, 9691, 830],   // warped: iteration
    [30795, 2394, 2176, 22349, 27887, 0],   // warped-half: step
    [50648, 8126, 3152, 38545, 47318, 0],   // warped-half: step with colliders
    [19549, 4153, 3082, 13082, 9692, 1215], // warped-half: iteration
    [21697, 1713, 1000, 16456, 18013, 0],   // laplacian: step
    [42120, 7401, 1980, 32770, 37438, 0],   // laplacian: step with colliders
    [16808, 1940, 1432, 7631, 9693, 634],   // laplacian: iteration
    [21711, 1712, 1000, 16459, 18013, 0],   // laplacian-half: step
    [42032, 7407, 1980, 32753, 37439, 0],   // laplacian-half: step with colliders
    [16605, 2169, 1560, 8292, 9693, 700],   // laplacian-half: iteration
    [32160, 17355, 1090, 29435, 27705, 0],  // two-level: step
    [60979, 23030, 2655, 39368, 37379, 0],  // two-level: step with colliders
    [11407, 2472, 1105, 8322, 9682, 0],     // two-level: iteration
    [-5578, 2239, -172, 0, 0, 0],           // a sphere
    [-4946, 4510, -487, 0, 0, 0],           // a capsule
    [-4912, 9790, -488, 0, 0, 0],           // a box
    [-4909, 10270, -488, 0, 0, 0],          // a height field
    [8884, 25118, 407, 0, 0, 0],            // a frame
    [3805, 0, 0, 18613, 10271, 0],          // plastic flow
    [4414, 0, 0, 29274, 4595, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [757, 1114, 357, 10858, 14158, 0],      // couplings: step
    [-12562, 759, 835, 5822, 5138, 0],      // couplings: diagonal where none was
    [4354, -815, -669, 5051, 3209, 0],      // couplings: diagonal for jacobi
    [15820, 1768, -105, -3445, -6781, 0],   // couplings: beside colliders
    [-85935, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-719, 80, -527, 0, 0, 0],              // couplings: an iteration
    [582, 44, -906, 0, 0, 0],               // couplings: an iteration with a factor
    [2693, -424, -1384, 1042, 174, -7],     // couplings: an iteration with half a factor
    [109616, 0, 0, 0, 0, 0],                // couplings: a slot
    [44919, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4484, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [0, 0, 0, 0, 0, 0],                     // couplings: a slot, a switch
    [0, 0, 0, 0, 0, 0],                     // couplings: a slot, a switch of a vector
    [34575, 0, 0, 0, 0, 0],                 // couplings: a link
    [2299, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [25645, 0, 0, 0, 0, 0],                 // couplings: a part
    [720, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [29704, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [5311, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [39261, 2246, 1025, 0, 0, 0],           // islands
    [14958, 466, -2553, 0, 0, 0],           // islands, a vector
    [5309, 200, -42, 0, 0, 0],              // islands, an iteration
    [1915, 0, 0, 0, 0, 0],                  // islands: a part
    [1362, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
