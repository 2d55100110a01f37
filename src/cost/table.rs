//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-131, 0, 0, 8790, 4, 0],                // any sweeps
    [32, 0, 0, 25899, -1, 0],                // a sweep
    [23354, 6426, 975, 22669, 13472, 0],     // a stored vector
    [3619, 781, 522, 0, 0, 0],               // a pair of them
    [1383, 391, 259, 0, 0, 0],               // a vector and iteration
    [2051, 2491, -29, 0, 0, 0],              // translations
    [1350, 889, 10, 0, 0, 0],                // translations, a vector
    [1929, 395, 7, 0, 0, 0],                 // translations, an iteration
    [2180, 1116, -24, 0, 0, 0],              // colliders, a vector
    [2192, 2718, -523, 0, 0, 0],             // colliders, an iteration
    [318, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11743, 16814, -91, 0, 0, 0],           // a collider
    [14051, 0, 0, 0, 0, 0],                  // a pin
    [-3960, 1180, 257, 22412, 13530, 0],     // pins or colliders that move
    [-28, 1129, -14, 22197, 13471, 0],       // newmark
    [-2721, 485, -12, 0, 0, 0],              // forces
    [11532, 4921, 7, 22556, 13466, 0],       // start from velocity
    [11324, 4969, 7, 22556, 13466, 0],       // start from velocity and force
    [14092, 4545, 252, 22558, 13467, 0],     // a search along the solution
    [-7982, -3184, 241, 0, 0, 0],            // a past velocity
    [-25294, -9549, 724, 0, 0, 0],           // rotations
    [-14078, 46, -6, 0, 0, 0],               // held by pins
    [26292, 1804, 1229, 0, 0, 0],            // coarse: an application more
    [2342, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21590, 0, 0, 0, 0, 0],                  // coarse: its square
    [4582, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33092, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111635, 0, 0, 0, 0, 0],                 // coarse: a product
    [12266, 0, 0, 0, 0, 0],                  // coarse: a sum
    [11424, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3355, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [17703, 3230, 484, 61088, 13141, 0],     // identity: step
    [36867, 12569, 883, 104178, 44986, 0],   // identity: step with colliders
    [10621, 1769, 784, 22264, 13471, 0],     // identity: iteration
    [17815, 3262, 484, 61089, 13141, 0],     // mass: step
    [36979, 12601, 883, 104178, 44986, 0],   // mass: step with colliders
    [10621, 1769, 784, 22264, 13471, 0],     // mass: iteration
    [18899, 4362, 487, 76087, 25034, 0],     // jacobi: step
    [27353, 13882, 817, 103794, 44980, 0],   // jacobi: step with colliders
    [11045, 1765, 784, 22293, 13472, 0],     // jacobi: iteration
    [18500, 5453, 483, 82268, 31510, 0],     // block-jacobi: step
    [36918, 14631, 882, 104188, 44988, 0],   // block-jacobi: step with colliders
    [10631, 1770, 784, 22259, 13471, 0],     // block-jacobi: iteration
    [17125, 7986, 341, 75691, 31495, 0],     // warped: step
    [34886, 16251, 887, 118850, 63335, 0],   // warped: step with colliders
    [13052, 5081, 19, 18341, 13472, 1614],   // warped: iteration
    [17110, 7987, 341, 75688, 31495, 0],     // warped-half: step
    [34934, 16247, 887, 118861, 63335, 0],   // warped-half: step with colliders
    [11730, 6256, 780, 22260, 13472, 1984],  // warped-half: iteration
    [15647, 2431, 314, 61040, 13143, 0],     // laplacian: step
    [33392, 10698, 860, 104196, 44983, 0],   // laplacian: step with colliders
    [13580, 3409, -214, 17143, 13472, 1289], // laplacian: iteration
    [15645, 2431, 314, 61040, 13143, 0],     // laplacian-half: step
    [33399, 10697, 860, 104197, 44983, 0],   // laplacian-half: step with colliders
    [13443, 3530, -135, 17548, 13472, 1327], // laplacian-half: iteration
    [38618, 21425, 385, 88133, 31461, 0],    // two-level: step
    [57509, 30582, 791, 110089, 44928, 0],   // two-level: step with colliders
    [13735, 3907, 790, 22313, 13470, 0],     // two-level: iteration
    [-8790, 2226, 67, 0, 0, 0],              // a sphere
    [-11513, 5660, 65, 0, 0, 0],             // a capsule
    [-11516, 13500, 64, 0, 0, 0],            // a box
    [-11516, 13820, 64, 0, 0, 0],            // a height field
    [10205, 19331, -118, 0, 0, 0],           // a frame
    [690, 0, 0, 69660, 14316, 0],            // plastic flow
    [6500, 0, 0, 230626, 675, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [45382, 2759, 1067, 21091, 13625, 0],    // couplings: step
    [-13050, 1231, 1141, 16889, 20072, 0],   // couplings: diagonal where none was
    [9571, -979, -962, 8595, 8718, 0],       // couplings: diagonal for jacobi
    [41221, 2903, -226, -3886, 10, 0],       // couplings: beside colliders
    [-101003, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [1490, 43, -100, 0, 0, 0],               // couplings: an iteration
    [3349, -18, 1575, 0, 0, 0],              // couplings: an iteration with a factor
    [2522, 517, -1745, 4849, -103, -351],    // couplings: an iteration with half a factor
    [134601, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46090, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4971, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [20337, 870, -1576, 0, 0, 0],            // couplings: a switch
    [6444, 1426, 181, 0, 0, 0],              // couplings: a switch of a vector
    [1972, 645, 198, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [5960, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5077, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [46417, 0, 0, 0, 0, 0],                  // couplings: a link
    [3525, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [10083, 0, 0, 0, 0, 0],                  // couplings: a part
    [887, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [49925, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5334, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [165859, 624, 3293, 0, 0, 0],            // islands
    [44124, 1274, -2400, 0, 0, 0],           // islands, a vector
    [19298, 306, 522, 0, 0, 0],              // islands, an iteration
    [1991, 0, 0, 0, 0, 0],                   // islands: a part
    [2212, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-180, 0, 0, 9480, -5, 0],               // any sweeps
    [84, 0, 0, 9453, 6, 0],                  // a sweep
    [25594, 3998, 1139, 9973, 11410, 0],     // a stored vector
    [2298, 385, 358, 0, 0, 0],               // a pair of them
    [811, 192, 174, 0, 0, 0],                // a vector and iteration
    [3853, 1841, 64, 0, 0, 0],               // translations
    [1749, 542, 40, 0, 0, 0],                // translations, a vector
    [1964, 229, 20, 0, 0, 0],                // translations, an iteration
    [1908, 731, 29, 0, 0, 0],                // colliders, a vector
    [4175, 2577, -37, 0, 0, 0],              // colliders, an iteration
    [-923, -791, -227, 0, 0, 0],             // colliders, an iteration with a factor
    [-11704, 17515, 1, 0, 0, 0],             // a collider
    [13533, 0, 0, 0, 0, 0],                  // a pin
    [-2964, 850, 307, 10102, 11545, 0],      // pins or colliders that move
    [1955, 1134, -59, 9928, 11425, 0],       // newmark
    [-1776, 360, -5, 0, 0, 0],               // forces
    [16251, 3611, 358, 10013, 11438, 0],     // start from velocity
    [15885, 3771, 358, 10013, 11438, 0],     // start from velocity and force
    [17474, 3055, 520, 9979, 11426, 0],      // a search along the solution
    [-12248, -2085, -105, 0, 0, 0],          // a past velocity
    [-39526, -5639, -461, 0, 0, 0],          // rotations
    [-13579, 35, -17, 0, 0, 0],              // held by pins
    [25416, 1970, 1024, 0, 0, 0],            // coarse: an application more
    [-19089, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34836, 0, 0, 0, 0, 0],                  // coarse: its square
    [863, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29146, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42626, 0, 0, 0, 0, 0],                  // coarse: a product
    [10549, 0, 0, 0, 0, 0],                  // coarse: a sum
    [15611, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1167, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26455, 2947, -109, 22979, 20856, 0],    // identity: step
    [51471, 10668, 747, 42644, 43555, 0],    // identity: step with colliders
    [10124, 1097, 637, 9986, 11405, 0],      // identity: iteration
    [26455, 3011, -109, 22979, 20856, 0],    // mass: step
    [51472, 10732, 747, 42644, 43555, 0],    // mass: step with colliders
    [10124, 1097, 637, 9986, 11405, 0],      // mass: iteration
    [27597, 3943, -116, 29140, 27313, 0],    // jacobi: step
    [44544, 11690, 761, 42801, 43508, 0],    // jacobi: step with colliders
    [10378, 1104, 639, 9984, 11408, 0],      // jacobi: iteration
    [27106, 5431, -112, 32399, 32188, 0],    // block-jacobi: step
    [51450, 13022, 747, 42642, 43555, 0],    // block-jacobi: step with colliders
    [10162, 1095, 637, 9988, 11405, 0],      // block-jacobi: iteration
    [28260, 3537, 5220, 31345, 32204, 0],    // warped: step
    [48458, 10353, 5887, 50694, 54912, 0],   // warped: step with colliders
    [16772, 4855, 1276, 9725, 11401, 1138],  // warped: iteration
    [28259, 3537, 5220, 31345, 32203, 0],    // warped-half: step
    [48460, 10353, 5887, 50695, 54913, 0],   // warped-half: step with colliders
    [15513, 5961, 2015, 13521, 11401, 1494], // warped-half: iteration
    [24178, 2560, -334, 22931, 20856, 0],    // laplacian: step
    [44375, 9376, 332, 42279, 43562, 0],     // laplacian: step with colliders
    [13232, 3192, 410, 8074, 11402, 839],    // laplacian: iteration
    [24178, 2560, -334, 22931, 20856, 0],    // laplacian-half: step
    [44373, 9376, 332, 42279, 43562, 0],     // laplacian-half: step with colliders
    [13048, 3328, 519, 8634, 11402, 887],    // laplacian-half: iteration
    [46392, 22974, -217, 38711, 32119, 0],   // two-level: step
    [71283, 30518, 666, 49049, 43509, 0],    // two-level: step with colliders
    [9714, 3330, 636, 10038, 11391, 0],      // two-level: iteration
    [-7874, 2185, -45, 0, 0, 0],             // a sphere
    [-6202, 4369, -545, 0, 0, 0],            // a capsule
    [-6151, 11089, -540, 0, 0, 0],           // a box
    [-6149, 11409, -540, 0, 0, 0],           // a height field
    [11750, 33543, 232, 0, 0, 0],            // a frame
    [1832, 0, 0, 23630, 12336, 0],           // plastic flow
    [5016, 0, 0, 43320, 5001, 0],            // fracture
    [513, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-71056, 5258, 9771, 152, 9201, 0],      // couplings: step
    [-7754, -311, -2956, 11713, 11154, 0],   // couplings: diagonal where none was
    [19879, -2746, -4554, 12332, 7905, 0],   // couplings: diagonal for jacobi
    [28257, 1250, -4158, 2251, 1122, 0],     // couplings: beside colliders
    [-101193, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [787, 33, 324, 0, 0, 0],                 // couplings: an iteration
    [-841, 12, -39, 0, 0, 0],                // couplings: an iteration with a factor
    [928, 148, -1776, 3195, -937, -239],     // couplings: an iteration with half a factor
    [123030, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54805, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4798, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [3049, 962, -4738, 0, 0, 0],             // couplings: a switch
    [3755, 499, 402, 0, 0, 0],               // couplings: a switch of a vector
    [1321, 285, 356, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [6299, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5234, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [38436, 0, 0, 0, 0, 0],                  // couplings: a link
    [3032, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [21134, 0, 0, 0, 0, 0],                  // couplings: a part
    [608, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [43994, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5860, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [47731, 575, 4199, 0, 0, 0],             // islands
    [15358, 633, -1938, 0, 0, 0],            // islands, a vector
    [6876, 77, 1535, 0, 0, 0],               // islands, an iteration
    [-1059, 0, 0, 0, 0, 0],                  // islands: a part
    [2256, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-52, 0, 0, 7109, 14, 0],               // any sweeps
    [63, 0, 0, 6612, 2, 0],                 // a sweep
    [23722, 2992, 1669, 8194, 9696, 0],     // a stored vector
    [1932, 297, 479, 0, 0, 0],              // a pair of them
    [776, 148, 237, 0, 0, 0],               // a vector and iteration
    [5622, 1107, 449, 0, 0, 0],             // translations
    [2473, 430, 207, 0, 0, 0],              // translations, a vector
    [1949, 179, 107, 0, 0, 0],              // translations, an iteration
    [3107, 485, 319, 0, 0, 0],              // colliders, a vector
    [7033, 1677, 591, 0, 0, 0],             // colliders, an iteration
    [-1840, -396, -381, 0, 0, 0],           // colliders, an iteration with a factor
    [-5955, 13938, 144, 0, 0, 0],           // a collider
    [8568, 0, 0, 0, 0, 0],                  // a pin
    [5, 510, 656, 7766, 9783, 0],           // pins or colliders that move
    [3034, 839, 174, 7902, 9705, 0],        // newmark
    [-142, 155, 144, 0, 0, 0],              // forces
    [17201, 2567, 902, 7994, 9715, 0],      // start from velocity
    [16977, 2615, 902, 7994, 9715, 0],      // start from velocity and force
    [18440, 2029, 1127, 8004, 9710, 0],     // a search along the solution
    [-11682, -1542, -260, 0, 0, 0],         // a past velocity
    [-36241, -4546, -793, 0, 0, 0],         // rotations
    [-8024, 17, 2, 0, 0, 0],                // held by pins
    [15249, 1779, 876, 0, 0, 0],            // coarse: an application more
    [-5767, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22435, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32721, 0, 0, 0, 0, 0],                 // coarse: a product
    [7474, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13395, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22463, 2212, 1178, 16371, 18005, 0],   // identity: step
    [50802, 8105, 2604, 33552, 37356, 0],   // identity: step with colliders
    [11450, 529, 1103, 8253, 9697, 0],      // identity: iteration
    [22495, 2260, 1178, 16371, 18005, 0],   // mass: step
    [50835, 8153, 2604, 33552, 37356, 0],   // mass: step with colliders
    [11451, 529, 1103, 8253, 9697, 0],      // mass: iteration
    [24625, 2838, 1270, 21504, 22902, 0],   // jacobi: step
    [53579, 8271, 2882, 34890, 37322, 0],   // jacobi: step with colliders
    [11328, 554, 1101, 8195, 9698, 0],      // jacobi: iteration
    [23073, 3843, 1178, 23776, 27706, 0],   // block-jacobi: step
    [50659, 9605, 2603, 33525, 37356, 0],   // block-jacobi: step with colliders
    [11549, 522, 1104, 8270, 9696, 0],      // block-jacobi: iteration
    [30657, 2399, 2184, 22327, 27816, 0],   // warped: step
    [50627, 8100, 3063, 38631, 47180, 0],   // warped: step with colliders
    [20505, 2895, 2297, 9057, 9691, 831],   // warped: iteration
    [30720, 2394, 2184, 22340, 27816, 0],   // warped-half: step
    [50304, 8125, 3060, 38564, 47182, 0],   // warped-half: step with colliders
    [19206, 4149, 3083, 13103, 9692, 1216], // warped-half: iteration
    [21686, 1712, 1005, 16445, 18006, 0],   // laplacian: step
    [41839, 7399, 1885, 32788, 37367, 0],   // laplacian: step with colliders
    [16463, 1938, 1433, 7654, 9693, 636],   // laplacian: iteration
    [21701, 1711, 1005, 16448, 18006, 0],   // laplacian-half: step
    [41751, 7406, 1885, 32771, 37367, 0],   // laplacian-half: step with colliders
    [16261, 2166, 1561, 8315, 9693, 702],   // laplacian-half: iteration
    [32376, 17354, 1096, 29423, 27633, 0],  // two-level: step
    [60984, 23029, 2554, 39385, 37306, 0],  // two-level: step with colliders
    [11057, 2472, 1107, 8354, 9682, 0],     // two-level: iteration
    [-5730, 2239, -193, 0, 0, 0],           // a sphere
    [-4971, 4579, -533, 0, 0, 0],           // a capsule
    [-4939, 9859, -534, 0, 0, 0],           // a box
    [-4936, 10339, -534, 0, 0, 0],          // a height field
    [9060, 25118, 418, 0, 0, 0],            // a frame
    [3257, 0, 0, 18469, 10250, 0],          // plastic flow
    [5310, 0, 0, 29378, 4600, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [-3125, 1475, 893, 9636, 9892, 0],      // couplings: step
    [-141, 211, -1551, 7388, 9587, 0],      // couplings: diagonal where none was
    [17808, -1552, -2502, 7126, 7904, 0],   // couplings: diagonal for jacobi
    [35045, 2256, -5297, -1806, -3084, 0],  // couplings: beside colliders
    [-86445, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-368, 90, -188, 0, 0, 0],              // couplings: an iteration
    [296, 36, -721, 0, 0, 0],               // couplings: an iteration with a factor
    [2649, -402, -837, 1051, -334, -23],    // couplings: an iteration with half a factor
    [110129, 0, 0, 0, 0, 0],                // couplings: a slot
    [44960, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4526, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [4967, 833, -3980, 0, 0, 0],            // couplings: a switch
    [3275, 397, 448, 0, 0, 0],              // couplings: a switch of a vector
    [1148, 228, 347, 0, 0, 0],              // couplings: a switch of a pair of vectors
    [5473, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch
    [4931, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch of a vector
    [35246, 0, 0, 0, 0, 0],                 // couplings: a link
    [2061, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [26619, 0, 0, 0, 0, 0],                 // couplings: a part
    [713, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [33357, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [4976, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [39142, 833, 4236, 0, 0, 0],            // islands
    [13834, 544, -2084, 0, 0, 0],           // islands, a vector
    [5148, 61, 1258, 0, 0, 0],              // islands, an iteration
    [-1803, 0, 0, 0, 0, 0],                 // islands: a part
    [2484, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
