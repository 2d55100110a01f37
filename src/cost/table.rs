//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-129, 0, 0, 9559, 4, 0],                // any sweeps
    [31, 0, 0, 27306, -1, 0],                // a sweep
    [24172, 6411, 1037, 22749, 13472, 0],    // a stored vector
    [3913, 779, 552, 0, 0, 0],               // a pair of them
    [1532, 390, 274, 0, 0, 0],               // a vector and iteration
    [2012, 2490, -32, 0, 0, 0],              // translations
    [1361, 890, 11, 0, 0, 0],                // translations, a vector
    [1926, 395, 8, 0, 0, 0],                 // translations, an iteration
    [2100, 1452, -35, 0, 0, 0],              // colliders, a vector
    [1719, 2721, -568, 0, 0, 0],             // colliders, an iteration
    [319, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11741, 16814, -97, 0, 0, 0],           // a collider
    [13933, 0, 0, 0, 0, 0],                  // a pin
    [-3704, 1175, 272, 22419, 13530, 0],     // pins or colliders that move
    [39, 1126, -15, 22207, 13471, 0],        // newmark
    [-2763, 485, -13, 0, 0, 0],              // forces
    [11577, 4922, 6, 22601, 13467, 0],       // start from velocity
    [11336, 4970, 6, 22600, 13467, 0],       // start from velocity and force
    [14292, 4543, 265, 22609, 13468, 0],     // a search along the solution
    [-7687, -3204, 254, 0, 0, 0],            // a past velocity
    [-24410, -9609, 764, 0, 0, 0],           // rotations
    [-13976, 46, -7, 0, 0, 0],               // held by pins
    [26237, 1805, 1220, 0, 0, 0],            // coarse: an application more
    [2237, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21610, 0, 0, 0, 0, 0],                  // coarse: its square
    [4581, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33087, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111638, 0, 0, 0, 0, 0],                 // coarse: a product
    [12266, 0, 0, 0, 0, 0],                  // coarse: a sum
    [12234, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3357, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [17993, 3205, 515, 58387, 13125, 0],     // identity: step
    [37306, 12561, 929, 101303, 44986, 0],   // identity: step with colliders
    [11188, 1757, 829, 22289, 13471, 0],     // identity: iteration
    [18105, 3237, 515, 58387, 13125, 0],     // mass: step
    [37418, 12593, 929, 101303, 44986, 0],   // mass: step with colliders
    [11188, 1757, 829, 22289, 13471, 0],     // mass: iteration
    [19137, 4340, 520, 73394, 25018, 0],     // jacobi: step
    [27456, 13899, 855, 100853, 44980, 0],   // jacobi: step with colliders
    [11628, 1751, 829, 22322, 13471, 0],     // jacobi: iteration
    [18815, 5427, 515, 79440, 31510, 0],     // block-jacobi: step
    [37364, 14622, 928, 101315, 44988, 0],   // block-jacobi: step with colliders
    [11193, 1758, 829, 22284, 13471, 0],     // block-jacobi: iteration
    [17258, 7965, 358, 72981, 31479, 0],     // warped: step
    [35384, 16240, 933, 115981, 63335, 0],   // warped: step with colliders
    [13610, 5072, 65, 18372, 13472, 1613],   // warped: iteration
    [17240, 7966, 358, 72977, 31479, 0],     // warped-half: step
    [35442, 16235, 934, 115994, 63335, 0],   // warped-half: step with colliders
    [12286, 6247, 826, 22292, 13472, 1983],  // warped-half: iteration
    [15778, 2411, 330, 58329, 13127, 0],     // laplacian: step
    [33884, 10687, 906, 101325, 44983, 0],   // laplacian: step with colliders
    [14141, 3399, -168, 17174, 13472, 1288], // laplacian: iteration
    [15776, 2411, 330, 58329, 13127, 0],     // laplacian-half: step
    [33892, 10687, 906, 101327, 44983, 0],   // laplacian-half: step with colliders
    [14003, 3521, -89, 17580, 13472, 1326],  // laplacian-half: iteration
    [38968, 21398, 417, 85307, 31462, 0],    // two-level: step
    [57969, 30574, 838, 107212, 44928, 0],   // two-level: step with colliders
    [14198, 3895, 834, 22336, 13470, 0],     // two-level: iteration
    [-8617, 2226, 73, 0, 0, 0],              // a sphere
    [-3366, 5042, 136, 0, 0, 0],             // a capsule
    [-3328, 12880, 146, 0, 0, 0],            // a box
    [-3327, 13200, 147, 0, 0, 0],            // a height field
    [10040, 19332, -116, 0, 0, 0],           // a frame
    [1066, 0, 0, 71251, 14404, 0],           // plastic flow
    [5771, 0, 0, 230769, 512, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [45359, 2671, 971, 20110, 13757, 0],     // couplings: step
    [-13103, 1236, 1171, 16728, 20124, 0],   // couplings: diagonal where none was
    [9336, -958, -916, 8377, 8741, 0],       // couplings: diagonal for jacobi
    [41129, 2878, -2, -3875, 56, 0],         // couplings: beside colliders
    [-101036, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [1297, 50, -139, 0, 0, 0],               // couplings: an iteration
    [3352, -19, 1575, 0, 0, 0],              // couplings: an iteration with a factor
    [2452, 507, -1740, 4775, -99, -343],     // couplings: an iteration with half a factor
    [134593, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46086, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4971, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [20287, 864, -1541, 0, 0, 0],            // couplings: a switch
    [6701, 1427, 178, 0, 0, 0],              // couplings: a switch of a vector
    [2101, 646, 187, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [5961, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5078, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [46445, 0, 0, 0, 0, 0],                  // couplings: a link
    [3526, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [10944, 0, 0, 0, 0, 0],                  // couplings: a part
    [889, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [49392, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5320, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [166384, 611, 3316, 0, 0, 0],            // islands
    [44030, 1286, -2523, 0, 0, 0],           // islands, a vector
    [19230, 307, 488, 0, 0, 0],              // islands, an iteration
    [1807, 0, 0, 0, 0, 0],                   // islands: a part
    [2273, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-172, 0, 0, 9511, -4, 0],               // any sweeps
    [87, 0, 0, 9836, 6, 0],                  // a sweep
    [26440, 3995, 1199, 10158, 11430, 0],    // a stored vector
    [2582, 384, 381, 0, 0, 0],               // a pair of them
    [959, 191, 183, 0, 0, 0],                // a vector and iteration
    [3890, 1832, 55, 0, 0, 0],               // translations
    [1757, 542, 44, 0, 0, 0],                // translations, a vector
    [1959, 229, 26, 0, 0, 0],                // translations, an iteration
    [2003, 795, 56, 0, 0, 0],                // colliders, a vector
    [3696, 2579, -67, 0, 0, 0],              // colliders, an iteration
    [-931, -791, -224, 0, 0, 0],             // colliders, an iteration with a factor
    [-11600, 17514, -39, 0, 0, 0],           // a collider
    [13342, 0, 0, 0, 0, 0],                  // a pin
    [-2575, 842, 339, 10235, 11565, 0],      // pins or colliders that move
    [2029, 1130, -64, 10063, 11446, 0],      // newmark
    [-1797, 360, -16, 0, 0, 0],              // forces
    [16403, 3614, 371, 10174, 11459, 0],     // start from velocity
    [16037, 3774, 371, 10174, 11458, 0],     // start from velocity and force
    [17789, 3056, 543, 10145, 11446, 0],     // a search along the solution
    [-12049, -2108, -118, 0, 0, 0],          // a past velocity
    [-38910, -5706, -507, 0, 0, 0],          // rotations
    [-13370, 35, -22, 0, 0, 0],              // held by pins
    [25334, 1953, 1023, 0, 0, 0],            // coarse: an application more
    [-19219, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [35140, 0, 0, 0, 0, 0],                  // coarse: its square
    [862, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29137, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42554, 0, 0, 0, 0, 0],                  // coarse: a product
    [10547, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16436, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26836, 2922, -67, 22774, 20840, 0],     // identity: step
    [52067, 10654, 925, 42527, 43541, 0],    // identity: step with colliders
    [10729, 1082, 673, 10135, 11426, 0],     // identity: iteration
    [26836, 2986, -68, 22774, 20840, 0],     // mass: step
    [52067, 10718, 925, 42527, 43540, 0],    // mass: step with colliders
    [10729, 1082, 673, 10135, 11426, 0],     // mass: iteration
    [27977, 3903, -71, 28931, 27297, 0],     // jacobi: step
    [45006, 11672, 900, 42649, 43493, 0],    // jacobi: step with colliders
    [10993, 1088, 677, 10135, 11429, 0],     // jacobi: iteration
    [27489, 5390, -71, 32179, 32156, 0],     // block-jacobi: step
    [52050, 12992, 924, 42526, 43540, 0],    // block-jacobi: step with colliders
    [10765, 1081, 673, 10137, 11425, 0],     // block-jacobi: iteration
    [28297, 3508, 5217, 31120, 32204, 0],    // warped: step
    [48930, 10329, 6024, 50569, 54915, 0],   // warped: step with colliders
    [17401, 4835, 1308, 9853, 11421, 1141],  // warped: iteration
    [28295, 3508, 5217, 31120, 32203, 0],    // warped-half: step
    [48940, 10328, 6025, 50572, 54915, 0],   // warped-half: step with colliders
    [16141, 5941, 2047, 13649, 11421, 1497], // warped-half: iteration
    [24344, 2542, -305, 22718, 20840, 0],    // laplacian: step
    [44967, 9364, 501, 42165, 43548, 0],     // laplacian: step with colliders
    [13860, 3172, 442, 8205, 11422, 842],    // laplacian: iteration
    [24344, 2542, -305, 22718, 20840, 0],    // laplacian-half: step
    [44966, 9364, 501, 42166, 43548, 0],     // laplacian-half: step with colliders
    [13675, 3308, 551, 8766, 11422, 890],    // laplacian-half: iteration
    [46800, 22916, -176, 38491, 32085, 0],   // two-level: step
    [71871, 30473, 843, 48928, 43494, 0],    // two-level: step with colliders
    [10249, 3300, 672, 10185, 11410, 0],     // two-level: iteration
    [-7665, 2185, -17, 0, 0, 0],             // a sphere
    [-7948, 4560, -523, 0, 0, 0],            // a capsule
    [-7900, 11280, -519, 0, 0, 0],           // a box
    [-7898, 11600, -519, 0, 0, 0],           // a height field
    [11452, 33536, 217, 0, 0, 0],            // a frame
    [2279, 0, 0, 24037, 12097, 0],           // plastic flow
    [5079, 0, 0, 43662, 5102, 0],            // fracture
    [514, 0, 0, 4734, 1, 0],                 // fracture: a place
    [-87627, 5033, 8463, 3003, 3927, 0],     // couplings: step
    [8110, -93, -1650, 9396, 16432, 0],      // couplings: diagonal where none was
    [35882, -2511, -3292, 10022, 13204, 0],  // couplings: diagonal for jacobi
    [43043, 1471, -2613, 14, 6340, 0],       // couplings: beside colliders
    [-101416, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [657, 41, 286, 0, 0, 0],                 // couplings: an iteration
    [-824, 7, -28, 0, 0, 0],                 // couplings: an iteration with a factor
    [1092, 149, -1809, 3166, -881, -237],    // couplings: an iteration with half a factor
    [123003, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54930, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4797, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [2078, 954, -4584, 0, 0, 0],             // couplings: a switch
    [3943, 501, 416, 0, 0, 0],               // couplings: a switch of a vector
    [1476, 285, 346, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [6309, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5234, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [38505, 0, 0, 0, 0, 0],                  // couplings: a link
    [3019, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [21701, 0, 0, 0, 0, 0],                  // couplings: a part
    [610, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [43551, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5861, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [48926, 550, 4090, 0, 0, 0],             // islands
    [15393, 655, -2042, 0, 0, 0],            // islands, a vector
    [7206, 79, 1456, 0, 0, 0],               // islands, an iteration
    [-1197, 0, 0, 0, 0, 0],                  // islands: a part
    [2297, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-52, 0, 0, 7509, 14, 0],               // any sweeps
    [62, 0, 0, 6548, 2, 0],                 // a sweep
    [23938, 2995, 1670, 8164, 9696, 0],     // a stored vector
    [2051, 297, 483, 0, 0, 0],              // a pair of them
    [842, 148, 236, 0, 0, 0],               // a vector and iteration
    [5602, 1107, 437, 0, 0, 0],             // translations
    [2476, 430, 210, 0, 0, 0],              // translations, a vector
    [1941, 179, 111, 0, 0, 0],              // translations, an iteration
    [3224, 537, 348, 0, 0, 0],              // colliders, a vector
    [6807, 1677, 590, 0, 0, 0],             // colliders, an iteration
    [-1845, -396, -378, 0, 0, 0],           // colliders, an iteration with a factor
    [-5869, 13937, 113, 0, 0, 0],           // a collider
    [8410, 0, 0, 0, 0, 0],                  // a pin
    [210, 511, 666, 7733, 9782, 0],         // pins or colliders that move
    [3087, 838, 165, 7871, 9704, 0],        // newmark
    [-157, 155, 135, 0, 0, 0],              // forces
    [17143, 2570, 895, 7964, 9714, 0],      // start from velocity
    [16919, 2618, 895, 7964, 9714, 0],      // start from velocity and force
    [18444, 2032, 1121, 7974, 9709, 0],     // a search along the solution
    [-11525, -1546, -270, 0, 0, 0],         // a past velocity
    [-35753, -4557, -830, 0, 0, 0],         // rotations
    [-7867, 17, -2, 0, 0, 0],               // held by pins
    [15073, 1779, 877, 0, 0, 0],            // coarse: an application more
    [-5768, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22436, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32720, 0, 0, 0, 0, 0],                 // coarse: a product
    [7475, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13779, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22485, 2213, 1173, 16381, 18012, 0],   // identity: step
    [51066, 8107, 2705, 33535, 37428, 0],   // identity: step with colliders
    [11681, 529, 1101, 8221, 9696, 0],      // identity: iteration
    [22516, 2261, 1172, 16381, 18012, 0],   // mass: step
    [51099, 8155, 2705, 33535, 37428, 0],   // mass: step with colliders
    [11682, 529, 1101, 8221, 9696, 0],      // mass: iteration
    [24644, 2839, 1266, 21514, 22909, 0],   // jacobi: step
    [53937, 8267, 2957, 34883, 37394, 0],   // jacobi: step with colliders
    [11557, 554, 1100, 8163, 9698, 0],      // jacobi: iteration
    [23095, 3844, 1172, 23787, 27777, 0],   // block-jacobi: step
    [50923, 9606, 2703, 33507, 37428, 0],   // block-jacobi: step with colliders
    [11780, 522, 1102, 8238, 9696, 0],      // block-jacobi: iteration
    [30600, 2398, 2176, 22336, 27887, 0],   // warped: step
    [50882, 8100, 3154, 38612, 47316, 0],   // warped: step with colliders
    [20731, 2898, 2295, 9034, 9691, 830],   // warped: iteration
    [30663, 2393, 2176, 22349, 27887, 0],   // warped-half: step
    [50558, 8125, 3152, 38545, 47318, 0],   // warped-half: step with colliders
    [19432, 4152, 3081, 13080, 9692, 1215], // warped-half: iteration
    [21645, 1713, 1000, 16456, 18013, 0],   // laplacian: step
    [42110, 7400, 1980, 32770, 37438, 0],   // laplacian: step with colliders
    [16690, 1940, 1432, 7630, 9693, 634],   // laplacian: iteration
    [21660, 1712, 1000, 16459, 18013, 0],   // laplacian-half: step
    [42022, 7407, 1980, 32753, 37439, 0],   // laplacian-half: step with colliders
    [16488, 2169, 1560, 8292, 9693, 700],   // laplacian-half: iteration
    [32465, 17355, 1090, 29435, 27705, 0],  // two-level: step
    [61312, 23030, 2655, 39369, 37379, 0],  // two-level: step with colliders
    [11286, 2472, 1105, 8322, 9682, 0],     // two-level: iteration
    [-5584, 2239, -172, 0, 0, 0],           // a sphere
    [-4587, 4586, -496, 0, 0, 0],           // a capsule
    [-4555, 9866, -498, 0, 0, 0],           // a box
    [-4552, 10346, -498, 0, 0, 0],          // a height field
    [8879, 25118, 406, 0, 0, 0],            // a frame
    [3192, 0, 0, 18570, 10269, 0],          // plastic flow
    [5388, 0, 0, 29354, 4598, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [18299, 343, -1290, 12954, 15851, 0],   // couplings: step
    [-21537, 1336, 631, 4181, 3627, 0],     // couplings: diagonal where none was
    [-3666, -421, -318, 3898, 1966, 0],     // couplings: diagonal for jacobi
    [13590, 3381, -3156, -5016, -9016, 0],  // couplings: beside colliders
    [-86444, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-348, 90, -188, 0, 0, 0],              // couplings: an iteration
    [276, 37, -727, 0, 0, 0],               // couplings: an iteration with a factor
    [2558, -402, -824, 1048, -376, -23],    // couplings: an iteration with half a factor
    [110155, 0, 0, 0, 0, 0],                // couplings: a slot
    [44958, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4526, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [5319, 827, -4040, 0, 0, 0],            // couplings: a switch
    [3431, 397, 449, 0, 0, 0],              // couplings: a switch of a vector
    [1208, 228, 346, 0, 0, 0],              // couplings: a switch of a pair of vectors
    [5468, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch
    [4931, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch of a vector
    [35130, 0, 0, 0, 0, 0],                 // couplings: a link
    [2154, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [26651, 0, 0, 0, 0, 0],                 // couplings: a part
    [710, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [33388, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [4975, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [38297, 835, 4279, 0, 0, 0],            // islands
    [13530, 545, -2078, 0, 0, 0],           // islands, a vector
    [4819, 63, 1283, 0, 0, 0],              // islands, an iteration
    [-1795, 0, 0, 0, 0, 0],                 // islands: a part
    [2485, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
