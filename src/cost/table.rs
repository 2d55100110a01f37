//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-130, 0, 0, 9559, 4, 0],                // any sweeps
    [31, 0, 0, 27306, -1, 0],                // a sweep
    [24032, 6420, 1037, 22749, 13472, 0],    // a stored vector
    [3913, 779, 552, 0, 0, 0],               // a pair of them
    [1532, 390, 274, 0, 0, 0],               // a vector and iteration
    [2011, 2490, -32, 0, 0, 0],              // translations
    [1377, 890, 11, 0, 0, 0],                // translations, a vector
    [1925, 395, 8, 0, 0, 0],                 // translations, an iteration
    [2102, 1453, -36, 0, 0, 0],              // colliders, a vector
    [1535, 2721, -567, 0, 0, 0],             // colliders, an iteration
    [302, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11860, 16814, -97, 0, 0, 0],           // a collider
    [14034, 0, 0, 0, 0, 0],                  // a pin
    [-3747, 1175, 270, 22419, 13530, 0],     // pins or colliders that move
    [43, 1126, -15, 22206, 13471, 0],        // newmark
    [-2773, 485, -13, 0, 0, 0],              // forces
    [11501, 4931, 5, 22601, 13467, 0],       // start from velocity
    [11261, 4979, 5, 22601, 13467, 0],       // start from velocity and force
    [13627, 4552, 266, 22610, 13468, 0],     // start from rest
    [-7611, -3213, 254, 0, 0, 0],            // a past velocity
    [-24181, -9637, 765, 0, 0, 0],           // rotations
    [-14060, 45, -7, 0, 0, 0],               // held by pins
    [26317, 1805, 1221, 0, 0, 0],            // coarse: an application more
    [2238, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21610, 0, 0, 0, 0, 0],                  // coarse: its square
    [4581, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33087, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111638, 0, 0, 0, 0, 0],                 // coarse: a product
    [12266, 0, 0, 0, 0, 0],                  // coarse: a sum
    [12234, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3357, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [17862, 3196, 515, 58386, 13125, 0],     // identity: step
    [36966, 12681, 931, 101298, 44986, 0],   // identity: step with colliders
    [11354, 1757, 829, 22290, 13471, 0],     // identity: iteration
    [17958, 3228, 515, 58386, 13125, 0],     // mass: step
    [37062, 12713, 931, 101298, 44986, 0],   // mass: step with colliders
    [11354, 1757, 829, 22290, 13471, 0],     // mass: iteration
    [18988, 4331, 519, 73394, 25018, 0],     // jacobi: step
    [27113, 14019, 857, 100851, 44980, 0],   // jacobi: step with colliders
    [11795, 1751, 829, 22322, 13471, 0],     // jacobi: iteration
    [18651, 5418, 515, 79439, 31510, 0],     // block-jacobi: step
    [37008, 14742, 930, 101311, 44988, 0],   // block-jacobi: step with colliders
    [11360, 1758, 829, 22284, 13471, 0],     // block-jacobi: iteration
    [17094, 8004, 357, 72981, 31511, 0],     // warped: step
    [34996, 16408, 935, 115977, 63367, 0],   // warped: step with colliders
    [13712, 5072, 65, 18373, 13472, 1613],   // warped: iteration
    [17076, 8005, 357, 72977, 31511, 0],     // warped-half: step
    [35054, 16403, 935, 115989, 63367, 0],   // warped-half: step with colliders
    [12389, 6247, 827, 22292, 13472, 1983],  // warped-half: iteration
    [15646, 2402, 330, 58329, 13127, 0],     // laplacian: step
    [33528, 10807, 908, 101321, 44983, 0],   // laplacian: step with colliders
    [14243, 3399, -168, 17174, 13472, 1288], // laplacian: iteration
    [15644, 2402, 330, 58328, 13127, 0],     // laplacian-half: step
    [33536, 10807, 908, 101323, 44983, 0],   // laplacian-half: step with colliders
    [14106, 3521, -89, 17580, 13472, 1326],  // laplacian-half: iteration
    [38819, 21390, 417, 85306, 31462, 0],    // two-level: step
    [57631, 30694, 840, 107209, 44928, 0],   // two-level: step with colliders
    [14365, 3895, 835, 22337, 13470, 0],     // two-level: iteration
    [-8583, 2226, 69, 0, 0, 0],              // a sphere
    [-4208, 5014, 142, 0, 0, 0],             // a capsule
    [-4373, 12857, 138, 0, 0, 0],            // a box
    [-4092, 13178, 133, 0, 0, 0],            // a height field
    [10539, 19333, -99, 0, 0, 0],            // a frame
    [1103, 0, 0, 71251, 14404, 0],           // plastic flow
    [6016, 0, 0, 230728, 510, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [32405, 2997, 2379, 18632, 13616, 0],    // couplings: step
    [-10577, 1057, 1423, 17312, 19392, 0],   // couplings: diagonal where none was
    [13916, -1130, -1309, 8904, 8458, 0],    // couplings: diagonal for jacobi
    [44419, 1397, 2261, -3564, -310, 0],     // couplings: beside colliders
    [-53114, 0, 0, 0, 0, 0],                 // couplings: a rigid body and collider
    [873, 40, -403, 0, 0, 0],                // couplings: an iteration
    [3393, -16, 1561, 0, 0, 0],              // couplings: an iteration with a factor
    [3476, 365, -2326, 4483, 719, -285],     // couplings: an iteration with half a factor
    [134071, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46061, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4884, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [45534, 0, 0, 0, 0, 0],                  // couplings: a link
    [3780, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [11149, 0, 0, 0, 0, 0],                  // couplings: a part
    [895, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [45438, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5626, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [147941, 3482, 2155, 0, 0, 0],           // islands
    [45950, 982, -3271, 0, 0, 0],            // islands, a vector
    [20790, 430, -152, 0, 0, 0],             // islands, an iteration
    [4394, 0, 0, 0, 0, 0],                   // islands: a part
    [1173, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-172, 0, 0, 9511, -4, 0],               // any sweeps
    [86, 0, 0, 9820, 6, 0],                  // a sweep
    [26314, 3995, 1196, 10190, 11414, 0],    // a stored vector
    [2582, 384, 382, 0, 0, 0],               // a pair of them
    [958, 191, 183, 0, 0, 0],                // a vector and iteration
    [3891, 1832, 56, 0, 0, 0],               // translations
    [1757, 542, 44, 0, 0, 0],                // translations, a vector
    [1962, 229, 25, 0, 0, 0],                // translations, an iteration
    [2006, 795, 55, 0, 0, 0],                // colliders, a vector
    [3651, 2579, -67, 0, 0, 0],              // colliders, an iteration
    [-930, -791, -224, 0, 0, 0],             // colliders, an iteration with a factor
    [-11724, 17514, -38, 0, 0, 0],           // a collider
    [13444, 0, 0, 0, 0, 0],                  // a pin
    [-2665, 843, 339, 10267, 11549, 0],      // pins or colliders that move
    [2053, 1129, -61, 10098, 11430, 0],      // newmark
    [-1806, 360, -16, 0, 0, 0],              // forces
    [16293, 3614, 368, 10206, 11443, 0],     // start from velocity
    [15927, 3774, 367, 10206, 11442, 0],     // start from velocity and force
    [17216, 3056, 540, 10178, 11431, 0],     // start from rest
    [-12003, -2108, -114, 0, 0, 0],          // a past velocity
    [-38771, -5706, -496, 0, 0, 0],          // rotations
    [-13457, 35, -22, 0, 0, 0],              // held by pins
    [25411, 1953, 1027, 0, 0, 0],            // coarse: an application more
    [-19162, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34850, 0, 0, 0, 0, 0],                  // coarse: its square
    [862, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29136, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42729, 0, 0, 0, 0, 0],                  // coarse: a product
    [10548, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16436, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26693, 2924, -66, 22772, 20840, 0],     // identity: step
    [51264, 10589, 871, 42548, 43525, 0],    // identity: step with colliders
    [10853, 1082, 673, 10167, 11410, 0],     // identity: iteration
    [26693, 2988, -66, 22772, 20840, 0],     // mass: step
    [51264, 10653, 871, 42548, 43525, 0],    // mass: step with colliders
    [10854, 1082, 673, 10167, 11410, 0],     // mass: iteration
    [27800, 3907, -72, 28927, 27297, 0],     // jacobi: step
    [44223, 11606, 847, 42673, 43477, 0],    // jacobi: step with colliders
    [11118, 1088, 677, 10167, 11413, 0],     // jacobi: iteration
    [27346, 5408, -69, 32210, 32156, 0],     // block-jacobi: step
    [51247, 12943, 870, 42547, 43524, 0],    // block-jacobi: step with colliders
    [10890, 1081, 673, 10169, 11409, 0],     // block-jacobi: iteration
    [28105, 3509, 5215, 31118, 32204, 0],    // warped: step
    [48093, 10263, 5967, 50589, 54899, 0],   // warped: step with colliders
    [17447, 4832, 1307, 9877, 11405, 1142],  // warped: iteration
    [28103, 3510, 5215, 31117, 32203, 0],    // warped-half: step
    [48103, 10262, 5967, 50592, 54900, 0],   // warped-half: step with colliders
    [16188, 5939, 2046, 13673, 11405, 1498], // warped-half: iteration
    [24233, 2545, -304, 22717, 20840, 0],    // laplacian: step
    [44212, 9300, 447, 42186, 43532, 0],     // laplacian: step with colliders
    [13910, 3183, 439, 8221, 11406, 844],    // laplacian: iteration
    [24233, 2545, -304, 22717, 20840, 0],    // laplacian-half: step
    [44211, 9300, 447, 42187, 43533, 0],     // laplacian-half: step with colliders
    [13722, 3306, 550, 8792, 11406, 891],    // laplacian-half: iteration
    [46746, 22935, -174, 38522, 32085, 0],   // two-level: step
    [71159, 30425, 789, 48950, 43478, 0],    // two-level: step with colliders
    [10342, 3300, 672, 10218, 11394, 0],     // two-level: iteration
    [-7657, 2186, -21, 0, 0, 0],             // a sphere
    [-9332, 4435, -599, 0, 0, 0],            // a capsule
    [-9518, 11243, -609, 0, 0, 0],           // a box
    [-9052, 11486, -625, 0, 0, 0],           // a height field
    [12197, 33541, 233, 0, 0, 0],            // a frame
    [2472, 0, 0, 23949, 11909, 0],           // plastic flow
    [4552, 0, 0, 43581, 5353, 0],            // fracture
    [513, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-84864, 7622, 9712, -5280, 2512, 0],    // couplings: step
    [11646, -747, -875, 12256, 12771, 0],    // couplings: diagonal where none was
    [33772, -2664, -2793, 11358, 8871, 0],   // couplings: diagonal for jacobi
    [44769, -709, 1790, 2008, 2978, 0],      // couplings: beside colliders
    [-55919, 0, 0, 0, 0, 0],                 // couplings: a rigid body and collider
    [545, 31, -141, 0, 0, 0],                // couplings: an iteration
    [-928, 46, -241, 0, 0, 0],               // couplings: an iteration with a factor
    [843, 0, -2524, 2505, 70, -152],         // couplings: an iteration with half a factor
    [122821, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54849, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4775, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [37895, 0, 0, 0, 0, 0],                  // couplings: a link
    [3197, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [-1858, 0, 0, 0, 0, 0],                  // couplings: a part
    [680, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [58295, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [6299, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [40528, 2612, -316, 0, 0, 0],            // islands
    [17320, 538, -2353, 0, 0, 0],            // islands, a vector
    [5711, 261, 76, 0, 0, 0],                // islands, an iteration
    [4211, 0, 0, 0, 0, 0],                   // islands: a part
    [708, 0, 0, 0, 0, 0],                    // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-51, 0, 0, 7509, 14, 0],               // any sweeps
    [62, 0, 0, 6548, 2, 0],                 // a sweep
    [23930, 2994, 1670, 8164, 9696, 0],     // a stored vector
    [2051, 297, 483, 0, 0, 0],              // a pair of them
    [842, 148, 236, 0, 0, 0],               // a vector and iteration
    [5602, 1107, 438, 0, 0, 0],             // translations
    [2476, 430, 210, 0, 0, 0],              // translations, a vector
    [1942, 179, 111, 0, 0, 0],              // translations, an iteration
    [3227, 537, 347, 0, 0, 0],              // colliders, a vector
    [6614, 1677, 590, 0, 0, 0],             // colliders, an iteration
    [-1831, -396, -378, 0, 0, 0],           // colliders, an iteration with a factor
    [-5940, 13937, 113, 0, 0, 0],           // a collider
    [8465, 0, 0, 0, 0, 0],                  // a pin
    [152, 511, 666, 7733, 9782, 0],         // pins or colliders that move
    [3089, 838, 165, 7871, 9704, 0],        // newmark
    [-170, 155, 135, 0, 0, 0],              // forces
    [17137, 2569, 896, 7964, 9714, 0],      // start from velocity
    [16913, 2617, 895, 7964, 9714, 0],      // start from velocity and force
    [18055, 2031, 1121, 7974, 9709, 0],     // start from rest
    [-11566, -1545, -270, 0, 0, 0],         // a past velocity
    [-35875, -4554, -830, 0, 0, 0],         // rotations
    [-7922, 17, -2, 0, 0, 0],               // held by pins
    [15104, 1779, 877, 0, 0, 0],            // coarse: an application more
    [-5770, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22436, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32784, 0, 0, 0, 0, 0],                 // coarse: a product
    [7475, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13780, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22507, 2214, 1172, 16381, 18012, 0],   // identity: step
    [50837, 8077, 2705, 33532, 37428, 0],   // identity: step with colliders
    [11799, 528, 1101, 8222, 9696, 0],      // identity: iteration
    [22538, 2262, 1172, 16381, 18012, 0],   // mass: step
    [50871, 8125, 2705, 33532, 37428, 0],   // mass: step with colliders
    [11799, 528, 1101, 8222, 9696, 0],      // mass: iteration
    [24667, 2840, 1266, 21513, 22909, 0],   // jacobi: step
    [53720, 8236, 2959, 34882, 37395, 0],   // jacobi: step with colliders
    [11674, 554, 1100, 8163, 9698, 0],      // jacobi: iteration
    [23085, 3845, 1172, 23786, 27777, 0],   // block-jacobi: step
    [50679, 9576, 2704, 33504, 37428, 0],   // block-jacobi: step with colliders
    [11897, 521, 1102, 8239, 9696, 0],      // block-jacobi: iteration
    [30639, 2399, 2175, 22336, 27887, 0],   // warped: step
    [50707, 8070, 3155, 38609, 47316, 0],   // warped: step with colliders
    [20848, 2898, 2296, 9035, 9691, 830],   // warped: iteration
    [30701, 2394, 2176, 22349, 27887, 0],   // warped-half: step
    [50382, 8095, 3153, 38542, 47318, 0],   // warped-half: step with colliders
    [19549, 4152, 3082, 13082, 9692, 1215], // warped-half: iteration
    [21603, 1714, 1000, 16456, 18013, 0],   // laplacian: step
    [41854, 7370, 1981, 32767, 37438, 0],   // laplacian: step with colliders
    [16808, 1940, 1432, 7631, 9693, 634],   // laplacian: iteration
    [21618, 1713, 1000, 16459, 18013, 0],   // laplacian-half: step
    [41766, 7377, 1981, 32750, 37439, 0],   // laplacian-half: step with colliders
    [16605, 2169, 1560, 8292, 9693, 700],   // laplacian-half: iteration
    [32066, 17356, 1090, 29434, 27705, 0],  // two-level: step
    [60712, 23000, 2655, 39365, 37379, 0],  // two-level: step with colliders
    [11407, 2472, 1105, 8323, 9682, 0],     // two-level: iteration
    [-5565, 2239, -174, 0, 0, 0],           // a sphere
    [-5933, 4546, -494, 0, 0, 0],           // a capsule
    [-6054, 9831, -506, 0, 0, 0],           // a box
    [-5751, 10313, -515, 0, 0, 0],          // a height field
    [9385, 25119, 420, 0, 0, 0],            // a frame
    [3803, 0, 0, 18612, 10271, 0],          // plastic flow
    [4637, 0, 0, 29314, 4597, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [906, 1077, 320, 10988, 14136, 0],      // couplings: step
    [-12662, 781, 919, 5746, 5147, 0],      // couplings: diagonal where none was
    [4369, -813, -644, 5039, 3245, 0],      // couplings: diagonal for jacobi
    [16260, 1849, -278, -3787, -6769, 0],   // couplings: beside colliders
    [-47671, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-722, 79, -536, 0, 0, 0],              // couplings: an iteration
    [293, 46, -855, 0, 0, 0],               // couplings: an iteration with a factor
    [3302, -510, -1519, 649, 174, 39],      // couplings: an iteration with half a factor
    [109605, 0, 0, 0, 0, 0],                // couplings: a slot
    [44919, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4486, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [34564, 0, 0, 0, 0, 0],                 // couplings: a link
    [2409, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [25824, 0, 0, 0, 0, 0],                 // couplings: a part
    [721, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [29420, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [5325, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [39308, 2250, 1045, 0, 0, 0],           // islands
    [14938, 464, -2566, 0, 0, 0],           // islands, a vector
    [5312, 200, -40, 0, 0, 0],              // islands, an iteration
    [1793, 0, 0, 0, 0, 0],                  // islands: a part
    [1375, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
