//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-130, 0, 0, 8790, 4, 0],                // any sweeps
    [32, 0, 0, 25899, -1, 0],                // a sweep
    [23207, 6425, 972, 22669, 13472, 0],     // a stored vector
    [3620, 781, 522, 0, 0, 0],               // a pair of them
    [1383, 391, 259, 0, 0, 0],               // a vector and iteration
    [2045, 2491, -29, 0, 0, 0],              // translations
    [1350, 889, 10, 0, 0, 0],                // translations, a vector
    [1929, 395, 7, 0, 0, 0],                 // translations, an iteration
    [2179, 1116, -24, 0, 0, 0],              // colliders, a vector
    [2193, 2718, -523, 0, 0, 0],             // colliders, an iteration
    [316, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11741, 16813, -91, 0, 0, 0],           // a collider
    [14053, 0, 0, 0, 0, 0],                  // a pin
    [-3898, 1180, 257, 22412, 13529, 0],     // pins or colliders that move
    [35, 1129, -14, 22197, 13471, 0],        // newmark
    [-2723, 485, -12, 0, 0, 0],              // forces
    [11379, 4921, 3, 22557, 13466, 0],       // start from velocity
    [11170, 4969, 3, 22557, 13466, 0],       // start from velocity and force
    [13939, 4545, 248, 22558, 13467, 0],     // a search along the solution
    [-7772, -3183, 244, 0, 0, 0],            // a past velocity
    [-24665, -9547, 734, 0, 0, 0],           // rotations
    [-14084, 46, -6, 0, 0, 0],               // held by pins
    [26298, 1804, 1231, 0, 0, 0],            // coarse: an application more
    [2344, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21589, 0, 0, 0, 0, 0],                  // coarse: its square
    [4582, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33091, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111636, 0, 0, 0, 0, 0],                 // coarse: a product
    [12266, 0, 0, 0, 0, 0],                  // coarse: a sum
    [11424, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3355, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [17443, 3232, 480, 61756, 13096, 0],     // identity: step
    [36732, 12571, 879, 104845, 44941, 0],   // identity: step with colliders
    [10684, 1769, 784, 22264, 13471, 0],     // identity: iteration
    [17555, 3264, 480, 61756, 13096, 0],     // mass: step
    [36844, 12603, 879, 104845, 44941, 0],   // mass: step with colliders
    [10684, 1769, 784, 22264, 13471, 0],     // mass: iteration
    [18703, 4364, 484, 76754, 24990, 0],     // jacobi: step
    [27215, 13884, 814, 104461, 44935, 0],   // jacobi: step with colliders
    [11108, 1765, 784, 22293, 13471, 0],     // jacobi: iteration
    [18303, 5454, 480, 82935, 31465, 0],     // block-jacobi: step
    [36782, 14633, 878, 104856, 44942, 0],   // block-jacobi: step with colliders
    [10694, 1770, 784, 22259, 13471, 0],     // block-jacobi: iteration
    [16928, 7987, 337, 76359, 31450, 0],     // warped: step
    [34815, 16252, 883, 119518, 63290, 0],   // warped: step with colliders
    [13115, 5081, 19, 18341, 13472, 1614],   // warped: iteration
    [16913, 7989, 337, 76355, 31450, 0],     // warped-half: step
    [34863, 16249, 883, 119528, 63290, 0],   // warped-half: step with colliders
    [11793, 6256, 780, 22260, 13472, 1984],  // warped-half: iteration
    [15388, 2433, 310, 61707, 13098, 0],     // laplacian: step
    [33258, 10700, 856, 104863, 44938, 0],   // laplacian: step with colliders
    [13643, 3409, -214, 17143, 13472, 1289], // laplacian: iteration
    [15386, 2433, 310, 61707, 13098, 0],     // laplacian-half: step
    [33265, 10699, 856, 104864, 44938, 0],   // laplacian-half: step with colliders
    [13506, 3531, -135, 17549, 13472, 1327], // laplacian-half: iteration
    [38423, 21426, 381, 88802, 31416, 0],    // two-level: step
    [57374, 30584, 788, 110757, 44883, 0],   // two-level: step with colliders
    [13798, 3907, 790, 22313, 13470, 0],     // two-level: iteration
    [-8793, 2226, 67, 0, 0, 0],              // a sphere
    [-11525, 5663, 60, 0, 0, 0],             // a capsule
    [-11527, 13503, 60, 0, 0, 0],            // a box
    [-11527, 13823, 60, 0, 0, 0],            // a height field
    [10204, 19332, -119, 0, 0, 0],           // a frame
    [829, 0, 0, 69661, 14320, 0],            // plastic flow
    [6566, 0, 0, 230625, 675, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [45418, 2760, 1080, 21084, 13630, 0],    // couplings: step
    [-12966, 1228, 1136, 16895, 20083, 0],   // couplings: diagonal where none was
    [9590, -982, -968, 8603, 8727, 0],       // couplings: diagonal for jacobi
    [41223, 2902, -231, -3881, 2, 0],        // couplings: beside colliders
    [-100998, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [1489, 43, -99, 0, 0, 0],                // couplings: an iteration
    [3349, -18, 1575, 0, 0, 0],              // couplings: an iteration with a factor
    [2530, 516, -1745, 4850, -100, -351],    // couplings: an iteration with half a factor
    [134603, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46090, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4972, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [20352, 871, -1576, 0, 0, 0],            // couplings: a switch
    [6450, 1426, 181, 0, 0, 0],              // couplings: a switch of a vector
    [1972, 645, 198, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [5959, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5077, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [46416, 0, 0, 0, 0, 0],                  // couplings: a link
    [3523, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [10102, 0, 0, 0, 0, 0],                  // couplings: a part
    [886, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [49922, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5334, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [166056, 624, 3296, 0, 0, 0],            // islands
    [44113, 1275, -2399, 0, 0, 0],           // islands, a vector
    [19292, 306, 522, 0, 0, 0],              // islands, an iteration
    [1992, 0, 0, 0, 0, 0],                   // islands: a part
    [2211, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-179, 0, 0, 9463, -5, 0],               // any sweeps
    [84, 0, 0, 9453, 6, 0],                  // a sweep
    [25887, 4000, 1149, 9979, 11410, 0],     // a stored vector
    [2299, 385, 358, 0, 0, 0],               // a pair of them
    [811, 192, 174, 0, 0, 0],                // a vector and iteration
    [3878, 1833, 71, 0, 0, 0],               // translations
    [1749, 542, 39, 0, 0, 0],                // translations, a vector
    [1965, 229, 20, 0, 0, 0],                // translations, an iteration
    [1908, 731, 29, 0, 0, 0],                // colliders, a vector
    [4177, 2577, -37, 0, 0, 0],              // colliders, an iteration
    [-923, -791, -227, 0, 0, 0],             // colliders, an iteration with a factor
    [-11709, 17515, 1, 0, 0, 0],             // a collider
    [13543, 0, 0, 0, 0, 0],                  // a pin
    [-2707, 847, 321, 10108, 11544, 0],      // pins or colliders that move
    [2130, 1134, -59, 9929, 11425, 0],       // newmark
    [-1780, 360, -5, 0, 0, 0],               // forces
    [16530, 3614, 368, 10018, 11438, 0],     // start from velocity
    [16164, 3774, 368, 10018, 11437, 0],     // start from velocity and force
    [17754, 3058, 530, 9984, 11426, 0],      // a search along the solution
    [-12279, -2090, -101, 0, 0, 0],          // a past velocity
    [-39618, -5653, -450, 0, 0, 0],          // rotations
    [-13594, 35, -17, 0, 0, 0],              // held by pins
    [25423, 1954, 1024, 0, 0, 0],            // coarse: an application more
    [-19089, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34836, 0, 0, 0, 0, 0],                  // coarse: its square
    [863, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29146, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42625, 0, 0, 0, 0, 0],                  // coarse: a product
    [10549, 0, 0, 0, 0, 0],                  // coarse: a sum
    [15611, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1167, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26639, 2948, -102, 23368, 20790, 0],    // identity: step
    [52081, 10666, 767, 43023, 43489, 0],    // identity: step with colliders
    [10389, 1094, 650, 9993, 11405, 0],      // identity: iteration
    [26639, 3012, -102, 23368, 20790, 0],    // mass: step
    [52082, 10730, 767, 43023, 43489, 0],    // mass: step with colliders
    [10389, 1094, 650, 9993, 11405, 0],      // mass: iteration
    [27990, 3943, -106, 29532, 27247, 0],    // jacobi: step
    [45140, 11688, 781, 43179, 43442, 0],    // jacobi: step with colliders
    [10644, 1100, 653, 9990, 11408, 0],      // jacobi: iteration
    [27466, 5433, -105, 32772, 32122, 0],    // block-jacobi: step
    [52060, 13020, 767, 43022, 43489, 0],    // block-jacobi: step with colliders
    [10427, 1092, 650, 9995, 11405, 0],      // block-jacobi: iteration
    [28621, 3538, 5227, 31735, 32137, 0],    // warped: step
    [49245, 10351, 5907, 51074, 54846, 0],   // warped: step with colliders
    [17111, 4863, 1303, 9733, 11401, 1139],  // warped: iteration
    [28621, 3538, 5226, 31734, 32137, 0],    // warped-half: step
    [49247, 10350, 5907, 51075, 54847, 0],   // warped-half: step with colliders
    [15851, 5969, 2041, 13529, 11401, 1495], // warped-half: iteration
    [24363, 2561, -327, 23320, 20790, 0],    // laplacian: step
    [44986, 9374, 352, 42659, 43496, 0],     // laplacian: step with colliders
    [13483, 3202, 422, 8073, 11402, 840],    // laplacian: iteration
    [24363, 2561, -327, 23320, 20790, 0],    // laplacian-half: step
    [44984, 9374, 352, 42659, 43496, 0],     // laplacian-half: step with colliders
    [13298, 3338, 531, 8634, 11402, 888],    // laplacian-half: iteration
    [46752, 22959, -210, 39085, 32054, 0],   // two-level: step
    [71896, 30499, 685, 49430, 43443, 0],    // two-level: step with colliders
    [9978, 3310, 650, 10045, 11391, 0],      // two-level: iteration
    [-7885, 2185, -45, 0, 0, 0],             // a sphere
    [-7226, 4428, -741, 0, 0, 0],            // a capsule
    [-7179, 11148, -734, 0, 0, 0],           // a box
    [-7177, 11468, -734, 0, 0, 0],           // a height field
    [11646, 33548, 212, 0, 0, 0],            // a frame
    [1918, 0, 0, 23633, 12032, 0],           // plastic flow
    [5311, 0, 0, 43282, 5325, 0],            // fracture
    [529, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-78449, 5253, 9313, 770, 7657, 0],      // couplings: step
    [-279, -305, -2504, 11067, 12799, 0],    // couplings: diagonal where none was
    [27302, -2744, -4120, 11721, 9523, 0],   // couplings: diagonal for jacobi
    [35412, 1251, -3683, 1642, 2798, 0],     // couplings: beside colliders
    [-101197, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [699, 37, 310, 0, 0, 0],                 // couplings: an iteration
    [-836, -4, -47, 0, 0, 0],                // couplings: an iteration with a factor
    [926, 151, -1781, 3201, -940, -240],     // couplings: an iteration with half a factor
    [122975, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54933, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4781, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [2763, 960, -4724, 0, 0, 0],             // couplings: a switch
    [3713, 499, 406, 0, 0, 0],               // couplings: a switch of a vector
    [1329, 284, 355, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [6288, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5234, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [38406, 0, 0, 0, 0, 0],                  // couplings: a link
    [3037, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [21143, 0, 0, 0, 0, 0],                  // couplings: a part
    [607, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [43993, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5860, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [47974, 572, 4193, 0, 0, 0],             // islands
    [15328, 636, -1956, 0, 0, 0],            // islands, a vector
    [7004, 78, 1527, 0, 0, 0],               // islands, an iteration
    [-1057, 0, 0, 0, 0, 0],                  // islands: a part
    [2254, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-52, 0, 0, 7109, 14, 0],               // any sweeps
    [62, 0, 0, 6612, 2, 0],                 // a sweep
    [23890, 2991, 1669, 8194, 9696, 0],     // a stored vector
    [1932, 297, 479, 0, 0, 0],              // a pair of them
    [776, 148, 237, 0, 0, 0],               // a vector and iteration
    [5620, 1107, 450, 0, 0, 0],             // translations
    [2473, 430, 207, 0, 0, 0],              // translations, a vector
    [1950, 179, 107, 0, 0, 0],              // translations, an iteration
    [3107, 485, 319, 0, 0, 0],              // colliders, a vector
    [7034, 1677, 591, 0, 0, 0],             // colliders, an iteration
    [-1840, -396, -381, 0, 0, 0],           // colliders, an iteration with a factor
    [-5958, 13938, 144, 0, 0, 0],           // a collider
    [8573, 0, 0, 0, 0, 0],                  // a pin
    [136, 510, 656, 7767, 9783, 0],         // pins or colliders that move
    [3160, 839, 174, 7902, 9704, 0],        // newmark
    [-144, 155, 144, 0, 0, 0],              // forces
    [17368, 2567, 903, 7994, 9714, 0],      // start from velocity
    [17144, 2615, 903, 7994, 9714, 0],      // start from velocity and force
    [18607, 2029, 1128, 8004, 9710, 0],     // a search along the solution
    [-11722, -1542, -261, 0, 0, 0],         // a past velocity
    [-36359, -4545, -795, 0, 0, 0],         // rotations
    [-8031, 17, 2, 0, 0, 0],                // held by pins
    [15247, 1779, 876, 0, 0, 0],            // coarse: an application more
    [-5768, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22435, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32721, 0, 0, 0, 0, 0],                 // coarse: a product
    [7474, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13395, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22588, 2211, 1182, 16677, 17955, 0],   // identity: step
    [51184, 8105, 2608, 33859, 37307, 0],   // identity: step with colliders
    [11579, 529, 1103, 8253, 9697, 0],      // identity: iteration
    [22619, 2259, 1182, 16677, 17955, 0],   // mass: step
    [51217, 8152, 2608, 33859, 37307, 0],   // mass: step with colliders
    [11579, 529, 1103, 8254, 9697, 0],      // mass: iteration
    [24880, 2837, 1274, 21810, 22852, 0],   // jacobi: step
    [53955, 8270, 2885, 35197, 37272, 0],   // jacobi: step with colliders
    [11456, 554, 1101, 8195, 9698, 0],      // jacobi: iteration
    [23325, 3842, 1182, 24083, 27656, 0],   // block-jacobi: step
    [51041, 9604, 2606, 33832, 37306, 0],   // block-jacobi: step with colliders
    [11678, 522, 1104, 8270, 9696, 0],      // block-jacobi: iteration
    [30912, 2398, 2188, 22634, 27766, 0],   // warped: step
    [51138, 8099, 3067, 38938, 47131, 0],   // warped: step with colliders
    [20632, 2895, 2297, 9057, 9691, 831],   // warped: iteration
    [30974, 2393, 2188, 22647, 27766, 0],   // warped-half: step
    [50815, 8124, 3064, 38871, 47132, 0],   // warped-half: step with colliders
    [19332, 4150, 3083, 13104, 9692, 1216], // warped-half: iteration
    [21812, 1711, 1009, 16752, 17956, 0],   // laplacian: step
    [42221, 7398, 1889, 33095, 37317, 0],   // laplacian: step with colliders
    [16590, 1938, 1433, 7655, 9693, 635],   // laplacian: iteration
    [21827, 1710, 1009, 16755, 17956, 0],   // laplacian-half: step
    [42133, 7405, 1888, 33078, 37317, 0],   // laplacian-half: step with colliders
    [16388, 2167, 1562, 8316, 9693, 702],   // laplacian-half: iteration
    [32630, 17353, 1100, 29730, 27583, 0],  // two-level: step
    [61369, 23027, 2558, 39693, 37257, 0],  // two-level: step with colliders
    [11185, 2472, 1107, 8354, 9682, 0],     // two-level: iteration
    [-5735, 2239, -192, 0, 0, 0],           // a sphere
    [-4977, 4579, -532, 0, 0, 0],           // a capsule
    [-4945, 9860, -533, 0, 0, 0],           // a box
    [-4943, 10340, -533, 0, 0, 0],          // a height field
    [9061, 25118, 417, 0, 0, 0],            // a frame
    [3520, 0, 0, 18472, 10250, 0],          // plastic flow
    [5438, 0, 0, 29378, 4600, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [-3013, 1473, 890, 9643, 9890, 0],      // couplings: step
    [19, 208, -1554, 7395, 9585, 0],        // couplings: diagonal where none was
    [17827, -1552, -2504, 7126, 7900, 0],   // couplings: diagonal for jacobi
    [35022, 2253, -5288, -1794, -3100, 0],  // couplings: beside colliders
    [-86446, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-368, 90, -188, 0, 0, 0],              // couplings: an iteration
    [295, 38, -723, 0, 0, 0],               // couplings: an iteration with a factor
    [2648, -404, -836, 1046, -333, -23],    // couplings: an iteration with half a factor
    [110127, 0, 0, 0, 0, 0],                // couplings: a slot
    [44960, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4526, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [4961, 831, -3978, 0, 0, 0],            // couplings: a switch
    [3263, 397, 450, 0, 0, 0],              // couplings: a switch of a vector
    [1149, 228, 346, 0, 0, 0],              // couplings: a switch of a pair of vectors
    [5474, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch
    [4931, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch of a vector
    [35247, 0, 0, 0, 0, 0],                 // couplings: a link
    [2063, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [26628, 0, 0, 0, 0, 0],                 // couplings: a part
    [713, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [33343, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [4976, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [39103, 835, 4234, 0, 0, 0],            // islands
    [13846, 545, -2085, 0, 0, 0],           // islands, a vector
    [5158, 62, 1256, 0, 0, 0],              // islands, an iteration
    [-1808, 0, 0, 0, 0, 0],                 // islands: a part
    [2485, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
