//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-129, 0, 0, 9559, 4, 0],                // any sweeps
    [31, 0, 0, 27306, -1, 0],                // a sweep
    [24185, 6410, 1037, 22749, 13472, 0],    // a stored vector
    [3913, 779, 552, 0, 0, 0],               // a pair of them
    [1532, 390, 274, 0, 0, 0],               // a vector and iteration
    [2013, 2490, -32, 0, 0, 0],              // translations
    [1377, 890, 11, 0, 0, 0],                // translations, a vector
    [1926, 395, 8, 0, 0, 0],                 // translations, an iteration
    [2100, 1452, -35, 0, 0, 0],              // colliders, a vector
    [1703, 2721, -568, 0, 0, 0],             // colliders, an iteration
    [287, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11740, 16814, -97, 0, 0, 0],           // a collider
    [13965, 0, 0, 0, 0, 0],                  // a pin
    [-3719, 1175, 272, 22419, 13530, 0],     // pins or colliders that move
    [39, 1126, -15, 22207, 13471, 0],        // newmark
    [-2763, 485, -13, 0, 0, 0],              // forces
    [11590, 4922, 6, 22601, 13467, 0],       // start from velocity
    [11350, 4970, 6, 22600, 13467, 0],       // start from velocity and force
    [14145, 4543, 265, 22609, 13468, 0],     // a search along the solution
    [-7764, -3203, 254, 0, 0, 0],            // a past velocity
    [-24639, -9608, 764, 0, 0, 0],           // rotations
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
    [18044, 3206, 515, 58387, 13125, 0],     // identity: step
    [37277, 12561, 929, 101303, 44986, 0],   // identity: step with colliders
    [11140, 1757, 829, 22289, 13471, 0],     // identity: iteration
    [18156, 3238, 515, 58387, 13125, 0],     // mass: step
    [37389, 12593, 929, 101303, 44986, 0],   // mass: step with colliders
    [11140, 1757, 829, 22289, 13471, 0],     // mass: iteration
    [19188, 4340, 520, 73394, 25018, 0],     // jacobi: step
    [27426, 13900, 855, 100853, 44980, 0],   // jacobi: step with colliders
    [11580, 1751, 829, 22322, 13471, 0],     // jacobi: iteration
    [18850, 5427, 515, 79440, 31510, 0],     // block-jacobi: step
    [37335, 14623, 929, 101315, 44988, 0],   // block-jacobi: step with colliders
    [11145, 1758, 829, 22284, 13471, 0],     // block-jacobi: iteration
    [17293, 7965, 358, 72981, 31479, 0],     // warped: step
    [35323, 16240, 933, 115981, 63335, 0],   // warped: step with colliders
    [13562, 5072, 65, 18372, 13472, 1613],   // warped: iteration
    [17275, 7966, 358, 72977, 31479, 0],     // warped-half: step
    [35381, 16235, 934, 115994, 63335, 0],   // warped-half: step with colliders
    [12238, 6247, 826, 22291, 13472, 1983],  // warped-half: iteration
    [15829, 2411, 330, 58329, 13127, 0],     // laplacian: step
    [33838, 10688, 906, 101325, 44983, 0],   // laplacian: step with colliders
    [14093, 3399, -168, 17174, 13472, 1288], // laplacian: iteration
    [15827, 2411, 330, 58329, 13127, 0],     // laplacian-half: step
    [33847, 10687, 906, 101327, 44983, 0],   // laplacian-half: step with colliders
    [13956, 3521, -89, 17579, 13472, 1326],  // laplacian-half: iteration
    [39035, 21399, 417, 85307, 31462, 0],    // two-level: step
    [57972, 30575, 838, 107212, 44928, 0],   // two-level: step with colliders
    [14150, 3895, 834, 22336, 13470, 0],     // two-level: iteration
    [-8617, 2226, 73, 0, 0, 0],              // a sphere
    [-2935, 5042, 136, 0, 0, 0],             // a capsule
    [-2897, 12880, 146, 0, 0, 0],            // a box
    [-2896, 13200, 147, 0, 0, 0],            // a height field
    [10055, 19332, -116, 0, 0, 0],           // a frame
    [1302, 0, 0, 71254, 14404, 0],           // plastic flow
    [5802, 0, 0, 230769, 512, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [33851, 3215, 2678, 18424, 13840, 0],    // couplings: step
    [-11976, 1074, 1370, 17285, 19161, 0],   // couplings: diagonal where none was
    [13642, -1165, -1417, 9014, 8285, 0],    // couplings: diagonal for jacobi
    [37963, 1973, 2570, -3375, -712, 0],     // couplings: beside colliders
    [-101905, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [1951, 41, -410, 0, 0, 0],               // couplings: an iteration
    [3865, -18, 1489, 0, 0, 0],              // couplings: an iteration with a factor
    [2499, 463, -2037, 4690, 735, -319],     // couplings: an iteration with half a factor
    [134636, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46074, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4952, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [0, 0, 0, 0, 0, 0],                      // x
    [0, 0, 0, 0, 0, 0],                      // x
    [0, 0, 0, 0, 0, 0],                      // x
    [5973, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5095, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [46176, 0, 0, 0, 0, 0],                  // couplings: a link
    [3521, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [10404, 0, 0, 0, 0, 0],                  // couplings: a part
    [891, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [45919, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5629, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [162777, 643, 1836, 0, 0, 0],            // islands
    [45754, 984, -3211, 0, 0, 0],            // islands, a vector
    [21011, 431, -137, 0, 0, 0],             // islands, an iteration
    [6952, 0, 0, 0, 0, 0],                   // islands: a part
    [1095, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-173, 0, 0, 9495, -4, 0],               // any sweeps
    [87, 0, 0, 9820, 6, 0],                  // a sweep
    [26412, 4004, 1198, 10158, 11414, 0],    // a stored vector
    [2582, 384, 381, 0, 0, 0],               // a pair of them
    [959, 191, 183, 0, 0, 0],                // a vector and iteration
    [3858, 1832, 55, 0, 0, 0],               // translations
    [1757, 542, 44, 0, 0, 0],                // translations, a vector
    [1959, 229, 26, 0, 0, 0],                // translations, an iteration
    [2003, 795, 56, 0, 0, 0],                // colliders, a vector
    [3696, 2579, -67, 0, 0, 0],              // colliders, an iteration
    [-931, -791, -224, 0, 0, 0],             // colliders, an iteration with a factor
    [-11601, 17514, -39, 0, 0, 0],           // a collider
    [13343, 0, 0, 0, 0, 0],                  // a pin
    [-2613, 847, 336, 10233, 11549, 0],      // pins or colliders that move
    [2029, 1130, -64, 10063, 11430, 0],      // newmark
    [-1797, 360, -16, 0, 0, 0],              // forces
    [16353, 3628, 367, 10173, 11443, 0],     // start from velocity
    [15987, 3788, 367, 10173, 11442, 0],     // start from velocity and force
    [17610, 3070, 538, 10144, 11430, 0],     // a search along the solution
    [-12101, -2117, -117, 0, 0, 0],          // a past velocity
    [-39064, -5734, -504, 0, 0, 0],          // rotations
    [-13373, 35, -22, 0, 0, 0],              // held by pins
    [25310, 1953, 1025, 0, 0, 0],            // coarse: an application more
    [-19161, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34850, 0, 0, 0, 0, 0],                  // coarse: its square
    [862, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29136, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42745, 0, 0, 0, 0, 0],                  // coarse: a product
    [10548, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16436, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26792, 2935, -73, 22769, 20840, 0],     // identity: step
    [52007, 10667, 920, 42522, 43556, 0],    // identity: step with colliders
    [10690, 1087, 669, 10134, 11410, 0],     // identity: iteration
    [26792, 2999, -73, 22769, 20840, 0],     // mass: step
    [52008, 10731, 920, 42522, 43556, 0],    // mass: step with colliders
    [10691, 1087, 669, 10134, 11410, 0],     // mass: iteration
    [27934, 3932, -76, 28927, 27297, 0],     // jacobi: step
    [44945, 11701, 895, 42644, 43509, 0],    // jacobi: step with colliders
    [10955, 1093, 674, 10133, 11413, 0],     // jacobi: iteration
    [27445, 5419, -76, 32175, 32187, 0],     // block-jacobi: step
    [51990, 13021, 919, 42522, 43556, 0],    // block-jacobi: step with colliders
    [10727, 1086, 670, 10135, 11409, 0],     // block-jacobi: iteration
    [28277, 3517, 5218, 31119, 32187, 0],    // warped: step
    [48910, 10338, 6026, 50568, 54915, 0],   // warped: step with colliders
    [17331, 4839, 1304, 9848, 11405, 1142],  // warped: iteration
    [28275, 3518, 5218, 31118, 32187, 0],    // warped-half: step
    [48921, 10337, 6026, 50571, 54915, 0],   // warped-half: step with colliders
    [16071, 5945, 2043, 13644, 11405, 1497], // warped-half: iteration
    [24339, 2550, -307, 22715, 20840, 0],    // laplacian: step
    [44962, 9373, 499, 42162, 43564, 0],     // laplacian: step with colliders
    [13807, 3176, 438, 8201, 11406, 842],    // laplacian: iteration
    [24338, 2550, -307, 22715, 20840, 0],    // laplacian-half: step
    [44961, 9372, 499, 42163, 43564, 0],     // laplacian-half: step with colliders
    [13622, 3312, 547, 8761, 11406, 890],    // laplacian-half: iteration
    [46862, 22945, -181, 38487, 32117, 0],   // two-level: step
    [71919, 30502, 838, 48924, 43510, 0],    // two-level: step with colliders
    [10195, 3305, 669, 10184, 11394, 0],     // two-level: iteration
    [-7667, 2185, -17, 0, 0, 0],             // a sphere
    [-8580, 4484, -635, 0, 0, 0],            // a capsule
    [-8536, 11204, -630, 0, 0, 0],           // a box
    [-8534, 11524, -630, 0, 0, 0],           // a height field
    [11400, 33544, 207, 0, 0, 0],            // a frame
    [2078, 0, 0, 23933, 12305, 0],           // plastic flow
    [4655, 0, 0, 43422, 4940, 0],            // fracture
    [514, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-80927, 5046, 9228, 2349, 6572, 0],     // couplings: step
    [2998, -357, -913, 10616, 13888, 0],     // couplings: diagonal where none was
    [26526, -2364, -2920, 9906, 10306, 0],   // couplings: diagonal for jacobi
    [34473, 388, 1882, 468, 3896, 0],        // couplings: beside colliders
    [-101178, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [1483, 23, -146, 0, 0, 0],               // couplings: an iteration
    [-395, 19, -260, 0, 0, 0],               // couplings: an iteration with a factor
    [423, 116, -2314, 3171, -71, -214],      // couplings: an iteration with half a factor
    [123212, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54768, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4836, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [0, 0, 0, 0, 0, 0],                      // x
    [0, 0, 0, 0, 0, 0],                      // x
    [0, 0, 0, 0, 0, 0],                      // x
    [6176, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5219, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [38420, 0, 0, 0, 0, 0],                  // couplings: a link
    [2987, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [20587, 0, 0, 0, 0, 0],                  // couplings: a part
    [624, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [39361, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [6332, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [36398, 665, -752, 0, 0, 0],             // islands
    [17063, 538, -2291, 0, 0, 0],            // islands, a vector
    [5869, 264, 97, 0, 0, 0],                // islands, an iteration
    [6064, 0, 0, 0, 0, 0],                   // islands: a part
    [669, 0, 0, 0, 0, 0],                    // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-52, 0, 0, 7509, 14, 0],               // any sweeps
    [62, 0, 0, 6548, 2, 0],                 // a sweep
    [23935, 2994, 1672, 8164, 9696, 0],     // a stored vector
    [2051, 297, 483, 0, 0, 0],              // a pair of them
    [842, 148, 236, 0, 0, 0],               // a vector and iteration
    [5588, 1107, 437, 0, 0, 0],             // translations
    [2476, 430, 210, 0, 0, 0],              // translations, a vector
    [1942, 179, 111, 0, 0, 0],              // translations, an iteration
    [3220, 537, 348, 0, 0, 0],              // colliders, a vector
    [6828, 1677, 590, 0, 0, 0],             // colliders, an iteration
    [-1845, -396, -378, 0, 0, 0],           // colliders, an iteration with a factor
    [-5864, 13937, 113, 0, 0, 0],           // a collider
    [8418, 0, 0, 0, 0, 0],                  // a pin
    [207, 511, 666, 7733, 9783, 0],         // pins or colliders that move
    [3083, 838, 165, 7871, 9704, 0],        // newmark
    [-162, 155, 135, 0, 0, 0],              // forces
    [17127, 2569, 897, 7964, 9714, 0],      // start from velocity
    [16903, 2617, 897, 7964, 9714, 0],      // start from velocity and force
    [18298, 2031, 1123, 7974, 9709, 0],     // a search along the solution
    [-11586, -1545, -272, 0, 0, 0],         // a past velocity
    [-35935, -4555, -836, 0, 0, 0],         // rotations
    [-7874, 17, -2, 0, 0, 0],               // held by pins
    [15080, 1779, 877, 0, 0, 0],            // coarse: an application more
    [-5768, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22436, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32784, 0, 0, 0, 0, 0],                 // coarse: a product
    [7475, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13779, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22500, 2213, 1176, 16384, 18012, 0],   // identity: step
    [51062, 8106, 2708, 33537, 37364, 0],   // identity: step with colliders
    [11694, 529, 1101, 8221, 9696, 0],      // identity: iteration
    [22532, 2261, 1176, 16384, 18012, 0],   // mass: step
    [51095, 8154, 2708, 33537, 37364, 0],   // mass: step with colliders
    [11695, 529, 1101, 8221, 9696, 0],      // mass: iteration
    [24660, 2839, 1269, 21516, 22909, 0],   // jacobi: step
    [53937, 8267, 2960, 34886, 37330, 0],   // jacobi: step with colliders
    [11570, 554, 1100, 8163, 9698, 0],      // jacobi: iteration
    [23079, 3843, 1175, 23789, 27713, 0],   // block-jacobi: step
    [50904, 9606, 2706, 33510, 37364, 0],   // block-jacobi: step with colliders
    [11792, 522, 1102, 8238, 9696, 0],      // block-jacobi: iteration
    [30679, 2398, 2179, 22339, 27919, 0],   // warped: step
    [50911, 8100, 3158, 38614, 47284, 0],   // warped: step with colliders
    [20744, 2898, 2295, 9034, 9691, 830],   // warped: iteration
    [30742, 2393, 2179, 22352, 27919, 0],   // warped-half: step
    [50587, 8125, 3155, 38547, 47286, 0],   // warped-half: step with colliders
    [19444, 4152, 3081, 13081, 9692, 1215], // warped-half: iteration
    [21645, 1713, 1003, 16458, 18013, 0],   // laplacian: step
    [42059, 7400, 1983, 32772, 37374, 0],   // laplacian: step with colliders
    [16703, 1940, 1432, 7631, 9693, 634],   // laplacian: iteration
    [21659, 1711, 1003, 16461, 18013, 0],   // laplacian-half: step
    [41971, 7407, 1983, 32756, 37375, 0],   // laplacian-half: step with colliders
    [16501, 2169, 1560, 8292, 9693, 700],   // laplacian-half: iteration
    [32449, 17354, 1093, 29437, 27641, 0],  // two-level: step
    [61292, 23029, 2658, 39371, 37315, 0],  // two-level: step with colliders
    [11299, 2472, 1105, 8322, 9682, 0],     // two-level: iteration
    [-5602, 2239, -171, 0, 0, 0],           // a sphere
    [-6288, 4581, -579, 0, 0, 0],           // a capsule
    [-6260, 9861, -580, 0, 0, 0],           // a box
    [-6257, 10341, -580, 0, 0, 0],          // a height field
    [8890, 25118, 409, 0, 0, 0],            // a frame
    [3277, 0, 0, 18530, 10267, 0],          // plastic flow
    [5124, 0, 0, 29495, 4592, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [-12674, 1925, 2107, 8499, 8965, 0],    // couplings: step
    [3810, -138, -948, 8286, 10193, 0],     // couplings: diagonal where none was
    [21904, -1780, -2532, 7692, 8561, 0],   // couplings: diagonal for jacobi
    [32727, 1338, -1792, -1107, -1986, 0],  // couplings: beside colliders
    [-86470, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [147, 79, -539, 0, 0, 0],               // couplings: an iteration
    [592, 44, -888, 0, 0, 0],               // couplings: an iteration with a factor
    [2986, -397, -1352, 1263, 205, -29],    // couplings: an iteration with half a factor
    [110197, 0, 0, 0, 0, 0],                // couplings: a slot
    [44936, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4530, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [0, 0, 0, 0, 0, 0],                     // x
    [0, 0, 0, 0, 0, 0],                     // x
    [0, 0, 0, 0, 0, 0],                     // x
    [5445, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch
    [4930, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch of a vector
    [35057, 0, 0, 0, 0, 0],                 // couplings: a link
    [2059, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [26136, 0, 0, 0, 0, 0],                 // couplings: a part
    [721, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [29407, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [5344, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [34167, 927, 133, 0, 0, 0],             // islands
    [15307, 464, -2536, 0, 0, 0],           // islands, a vector
    [5693, 200, -14, 0, 0, 0],              // islands, an iteration
    [3989, 0, 0, 0, 0, 0],                  // islands: a part
    [1368, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
