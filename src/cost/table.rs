//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-397, 0, 0, 9266, 1, 0],                // any sweeps
    [99, 0, 0, 27796, 0, 0],                 // a sweep
    [23629, 6254, 1095, 22753, 13472, 0],    // a stored vector
    [3670, 782, 555, 0, 0, 0],               // a pair of them
    [1851, 389, 277, 0, 0, 0],               // a vector and iteration
    [3384, 2296, -7, 0, 0, 0],               // translations
    [1104, 940, 3, 0, 0, 0],                 // translations, a vector
    [526, 402, 2, 0, 0, 0],                  // translations, an iteration
    [2756, 608, 368, 0, 0, 0],               // colliders, a vector
    [-57, 400, 1, 0, 0, 0],                  // colliders, an iteration
    [0, 0, 0, 0, 0, 0], // colliders, an iteration with a factor
    [732, 9208, 3, 0, 0, 0],                 // a collider
    [505, 0, 0, 0, 0, 0],                    // a pin
    [5111, 976, 286, 22259, 13484, 0],       // pins or colliders that move
    [2709, 936, 2, 22108, 13473, 0],         // newmark
    [401, 450, 1, 0, 0, 0],                  // forces
    [12085, 4782, 77, 22509, 13473, 0],      // start from velocity
    [11909, 4814, 77, 22509, 13473, 0],      // start from velocity and force
    [14017, 4604, 354, 22570, 13472, 0],     // start from rest
    [-7270, -3464, 196, 0, 0, 0],            // a past velocity
    [-22703, -10162, 588, 0, 0, 0],          // rotations
    [673, -4, 0, 0, 0, 0],                   // held by pins
    [10206, 1981, 1167, 0, 0, 0],            // coarse: an application more
    [2323, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21589, 0, 0, 0, 0, 0],                  // coarse: its square
    [4582, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33087, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111651, 0, 0, 0, 0, 0],                 // coarse: a product
    [12262, 0, 0, 0, 0, 0],                  // coarse: a sum
    [12238, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3357, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [14873, 3078, 444, 57911, 13161, 0],     // identity: step
    [23772, 6382, 993, 101217, 45065, 0],    // identity: step with colliders
    [10756, 1745, 829, 22326, 13472, 0],     // identity: iteration
    [14969, 3110, 444, 57911, 13161, 0],     // mass: step
    [23868, 6414, 993, 101217, 45065, 0],    // mass: step with colliders
    [10756, 1745, 829, 22326, 13472, 0],     // mass: iteration
    [15512, 4238, 444, 72969, 25049, 0],     // jacobi: step
    [24033, 7269, 995, 101180, 45065, 0],    // jacobi: step with colliders
    [10799, 1741, 829, 22336, 13472, 0],     // jacobi: iteration
    [15711, 5318, 444, 78935, 31593, 0],     // block-jacobi: step
    [23821, 8462, 993, 101217, 45065, 0],    // block-jacobi: step with colliders
    [10754, 1745, 829, 22326, 13472, 0],     // block-jacobi: iteration
    [14540, 7249, 283, 72644, 31545, 0],     // warped: step
    [23451, 10552, 832, 115951, 63449, 0],   // warped: step with colliders
    [13178, 5063, 65, 18395, 13472, 1615],   // warped: iteration
    [14538, 7249, 283, 72644, 31545, 0],     // warped-half: step
    [23454, 10552, 832, 115951, 63449, 0],   // warped-half: step with colliders
    [11861, 6237, 827, 22314, 13472, 1986],  // warped-half: iteration
    [13009, 1646, 256, 57867, 13161, 0],     // laplacian: step
    [21921, 4949, 805, 101174, 45065, 0],    // laplacian: step with colliders
    [13709, 3392, -167, 17198, 13472, 1290], // laplacian: iteration
    [13009, 1646, 256, 57867, 13161, 0],     // laplacian-half: step
    [21922, 4949, 805, 101174, 45065, 0],    // laplacian-half: step with colliders
    [13572, 3514, -88, 17604, 13472, 1328],  // laplacian-half: iteration
    [35837, 21293, 351, 84776, 31548, 0],    // two-level: step
    [44121, 24426, 897, 107088, 45012, 0],   // two-level: step with colliders
    [13732, 3882, 833, 22382, 13471, 0],     // two-level: iteration
    [499, 1345, -5, 0, 0, 0],                // a sphere
    [1618, 5229, 34, 0, 0, 0],               // a capsule
    [1626, 9932, 36, 0, 0, 0],               // a box
    [1627, 10124, 36, 0, 0, 0],              // a height field
    [125, 11102, 4, 0, 0, 0],                // a frame
    [5371, 0, 0, 71995, 14346, 0],           // plastic flow
    [4719, 0, 0, 229998, 535, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [17358, 3828, 2607, 19238, 13620, 0],    // couplings: step
    [-11052, 1133, 1546, 17127, 18897, 0],   // couplings: diagonal where none was
    [15716, -1163, -1436, 9043, 8449, 0],    // couplings: diagonal for jacobi
    [2472, 229, 128, -1502, 1164, 0],        // couplings: beside colliders
    [-39590, 0, 0, 0, 0, 0],                 // couplings: a rigid body and collider
    [377, 46, -425, 0, 0, 0],                // couplings: an iteration
    [3635, -47, 1532, 0, 0, 0],              // couplings: an iteration with a factor
    [3963, 315, -2484, 4726, 176, -344],     // couplings: an iteration with half a factor
    [134019, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46049, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4882, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [45649, 0, 0, 0, 0, 0],                  // couplings: a link
    [3732, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [12807, 0, 0, 0, 0, 0],                  // couplings: a part
    [906, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [46802, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5647, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [63408, 2339, 2224, 0, 0, 0],            // islands
    [44934, 1045, -3305, 0, 0, 0],           // islands, a vector
    [20102, 431, -172, 0, 0, 0],             // islands, an iteration
    [2890, 0, 0, 0, 0, 0],                   // islands: a part
    [1072, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-333, 0, 0, 9542, 10, 0],               // any sweeps
    [125, 0, 0, 9821, 2, 0],                 // a sweep
    [26821, 4028, 1332, 10162, 11440, 0],    // a stored vector
    [2407, 385, 378, 0, 0, 0],               // a pair of them
    [1220, 191, 189, 0, 0, 0],               // a vector and iteration
    [4859, 1681, 126, 0, 0, 0],              // translations
    [1543, 582, 25, 0, 0, 0],                // translations, a vector
    [818, 232, 13, 0, 0, 0],                 // translations, an iteration
    [2060, 268, 277, 0, 0, 0],               // colliders, a vector
    [656, 378, 141, 0, 0, 0],                // colliders, an iteration
    [0, 0, 0, 0, 0, 0], // colliders, an iteration with a factor
    [870, 9718, 5, 0, 0, 0],                 // a collider
    [378, 0, 0, 0, 0, 0],                    // a pin
    [6072, 696, 317, 10112, 11464, 0],       // pins or colliders that move
    [4845, 866, 81, 10068, 11447, 0],        // newmark
    [705, 339, 18, 0, 0, 0],                 // forces
    [17443, 3683, 530, 10100, 11448, 0],     // start from velocity
    [17484, 3701, 554, 10112, 11448, 0],     // start from velocity and force
    [18053, 3402, 604, 10059, 11449, 0],     // start from rest
    [-12231, -2571, -98, 0, 0, 0],           // a past velocity
    [-36688, -7535, -716, 0, 0, 0],          // rotations
    [605, -3, 1, 0, 0, 0],                   // held by pins
    [10515, 2086, 917, 0, 0, 0],             // coarse: an application more
    [-19088, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34831, 0, 0, 0, 0, 0],                  // coarse: its square
    [863, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29149, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42637, 0, 0, 0, 0, 0],                  // coarse: a product
    [10546, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16499, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [23765, 3492, -114, 22871, 20880, 0],    // identity: step
    [33187, 5939, 370, 42453, 43635, 0],     // identity: step with colliders
    [10323, 1082, 686, 10144, 11445, 0],     // identity: iteration
    [23765, 3556, -114, 22871, 20880, 0],    // mass: step
    [33187, 6003, 369, 42454, 43635, 0],     // mass: step with colliders
    [10323, 1082, 686, 10144, 11445, 0],     // mass: iteration
    [24667, 4475, -118, 29056, 27268, 0],    // jacobi: step
    [33899, 6641, 372, 42528, 43626, 0],     // jacobi: step with colliders
    [10275, 1086, 686, 10133, 11446, 0],     // jacobi: iteration
    [24469, 6007, -117, 32274, 32211, 0],    // block-jacobi: step
    [33215, 8324, 368, 42452, 43632, 0],     // block-jacobi: step with colliders
    [10336, 1081, 686, 10146, 11444, 0],     // block-jacobi: iteration
    [25403, 2902, 5170, 31281, 32230, 0],    // warped: step
    [34677, 5361, 5654, 50829, 54990, 0],    // warped: step with colliders
    [17340, 4822, 1350, 9861, 11437, 1146],  // warped: iteration
    [25411, 2901, 5170, 31283, 32230, 0],    // warped-half: step
    [34653, 5363, 5654, 50823, 54990, 0],    // warped-half: step with colliders
    [16088, 5928, 2089, 13656, 11437, 1501], // warped-half: iteration
    [21478, 1935, -355, 22812, 20883, 0],    // laplacian: step
    [30766, 4392, 128, 42367, 43641, 0],     // laplacian: step with colliders
    [13563, 3168, 465, 8216, 11439, 844],    // laplacian: iteration
    [21479, 1935, -355, 22813, 20883, 0],    // laplacian-half: step
    [30760, 4392, 128, 42366, 43641, 0],     // laplacian-half: step with colliders
    [13379, 3305, 574, 8777, 11439, 892],    // laplacian-half: iteration
    [43947, 23522, -216, 38594, 32145, 0],   // two-level: step
    [52856, 25820, 271, 48821, 43569, 0],    // two-level: step with colliders
    [9668, 3306, 682, 10187, 11429, 0],      // two-level: iteration
    [392, 1250, -3, 0, 0, 0],                // a sphere
    [-1015, 5114, -530, 0, 0, 0],            // a capsule
    [-969, 9146, -528, 0, 0, 0],             // a box
    [-967, 9338, -528, 0, 0, 0],             // a height field
    [218, 19600, 23, 0, 0, 0],               // a frame
    [3768, 0, 0, 24030, 11692, 0],           // plastic flow
    [5517, 0, 0, 43240, 5419, 0],            // fracture
    [513, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-82179, 7616, 9123, -3901, 3257, 0],    // couplings: step
    [8458, -443, 33, 11145, 11840, 0],       // couplings: diagonal where none was
    [31298, -2378, -2356, 10393, 8073, 0],   // couplings: diagonal for jacobi
    [22802, -1148, 1137, 3056, 2317, 0],     // couplings: beside colliders
    [-41554, 0, 0, 0, 0, 0],                 // couplings: a rigid body and collider
    [-136, 40, -126, 0, 0, 0],               // couplings: an iteration
    [-917, 44, -345, 0, 0, 0],               // couplings: an iteration with a factor
    [372, -3, -2957, 2645, -326, -148],      // couplings: an iteration with half a factor
    [122945, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54714, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4761, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [37903, 0, 0, 0, 0, 0],                  // couplings: a link
    [3231, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [932, 0, 0, 0, 0, 0],                    // couplings: a part
    [652, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [57739, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [6265, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [27034, 2009, -245, 0, 0, 0],            // islands
    [16342, 595, -2419, 0, 0, 0],            // islands, a vector
    [5161, 259, 41, 0, 0, 0],                // islands, an iteration
    [2057, 0, 0, 0, 0, 0],                   // islands: a part
    [691, 0, 0, 0, 0, 0],                    // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-186, 0, 0, 7551, 16, 0],              // any sweeps
    [93, 0, 0, 6538, 1, 0],                 // a sweep
    [25201, 2744, 1873, 8146, 9694, 0],     // a stored vector
    [1955, 298, 476, 0, 0, 0],              // a pair of them
    [995, 147, 238, 0, 0, 0],               // a vector and iteration
    [5786, 1027, 446, 0, 0, 0],             // translations
    [2463, 451, 209, 0, 0, 0],              // translations, a vector
    [1287, 181, 106, 0, 0, 0],              // translations, an iteration
    [1671, 211, 351, 0, 0, 0],              // colliders, a vector
    [940, 189, 197, 0, 0, 0],               // colliders, an iteration
    [0, 0, 0, 0, 0, 0], // colliders, an iteration with a factor
    [698, 7863, 6, 0, 0, 0],                // a collider
    [556, 0, 0, 0, 0, 0],                   // a pin
    [5571, 394, 608, 7776, 9712, 0],        // pins or colliders that move
    [6804, 319, 469, 8114, 9698, 0],        // newmark
    [1297, 144, 155, 0, 0, 0],              // forces
    [18745, 2413, 1167, 7878, 9701, 0],     // start from velocity
    [18850, 2416, 1211, 7896, 9701, 0],     // start from velocity and force
    [17858, 2345, 1136, 7775, 9702, 0],     // start from rest
    [-12275, -1867, -265, 0, 0, 0],         // a past velocity
    [-37241, -5356, -1323, 0, 0, 0],        // rotations
    [495, -3, 2, 0, 0, 0],                  // held by pins
    [6117, 1856, 754, 0, 0, 0],             // coarse: an application more
    [-5724, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24808, 0, 0, 0, 0, 0],                 // coarse: its square
    [778, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22433, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32858, 0, 0, 0, 0, 0],                 // coarse: a product
    [7472, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13779, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [908, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [21147, 2461, 1177, 16533, 18014, 0],   // identity: step
    [30671, 4345, 1961, 32079, 37519, 0],   // identity: step with colliders
    [10741, 558, 1099, 8148, 9698, 0],      // identity: iteration
    [21179, 2493, 1177, 16532, 18014, 0],   // mass: step
    [30704, 4377, 1961, 32079, 37519, 0],   // mass: step with colliders
    [10741, 558, 1099, 8148, 9698, 0],      // mass: iteration
    [23240, 3050, 1278, 21710, 22916, 0],   // jacobi: step
    [30491, 4858, 1956, 31979, 37513, 0],   // jacobi: step with colliders
    [10590, 570, 1098, 8117, 9699, 0],      // jacobi: iteration
    [21932, 4271, 1179, 23967, 27842, 0],   // block-jacobi: step
    [30676, 6026, 1959, 32076, 37516, 0],   // block-jacobi: step with colliders
    [10761, 557, 1099, 8151, 9697, 0],      // block-jacobi: iteration
    [29630, 1755, 2232, 22471, 28052, 0],   // warped: step
    [38938, 3657, 3014, 37968, 47560, 0],   // warped: step with colliders
    [19759, 2920, 2274, 8936, 9691, 833],   // warped: iteration
    [29649, 1753, 2232, 22475, 28052, 0],   // warped-half: step
    [38886, 3662, 3013, 37955, 47561, 0],   // warped-half: step with colliders
    [18421, 4176, 3058, 12970, 9692, 1219], // warped-half: iteration
    [20281, 1051, 1004, 16568, 18018, 0],   // laplacian: step
    [29603, 2951, 1785, 32073, 37525, 0],   // laplacian: step with colliders
    [15716, 1962, 1425, 7562, 9693, 635],   // laplacian: iteration
    [20286, 1050, 1004, 16569, 18018, 0],   // laplacian-half: step
    [29587, 2952, 1785, 32069, 37525, 0],   // laplacian-half: step with colliders
    [15504, 2191, 1553, 8221, 9693, 701],   // laplacian-half: iteration
    [31612, 17737, 1108, 29721, 27773, 0],  // two-level: step
    [40631, 19466, 1898, 37897, 37452, 0],  // two-level: step with colliders
    [9979, 2529, 1095, 8184, 9683, 0],      // two-level: iteration
    [264, 1042, -8, 0, 0, 0],               // a sphere
    [-1003, 4415, -430, 0, 0, 0],           // a capsule
    [-973, 7584, -429, 0, 0, 0],            // a box
    [-970, 7872, -429, 0, 0, 0],            // a height field
    [190, 14794, -6, 0, 0, 0],              // a frame
    [4531, 0, 0, 18562, 10255, 0],          // plastic flow
    [4712, 0, 0, 29414, 4568, 0],           // fracture
    [450, 0, 0, 3582, 1, 0],                // fracture: a place
    [-19476, 2292, 2068, 8543, 7982, 0],    // couplings: step
    [7065, -237, -798, 8513, 11385, 0],     // couplings: diagonal where none was
    [23648, -1759, -2863, 7707, 9464, 0],   // couplings: diagonal for jacobi
    [13148, -538, -1000, 1246, 2471, 0],    // couplings: beside colliders
    [-33099, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-1292, 79, -417, 0, 0, 0],             // couplings: an iteration
    [293, 47, -889, 0, 0, 0],               // couplings: an iteration with a factor
    [3172, -571, -1971, 269, 73, 87],       // couplings: an iteration with half a factor
    [109697, 0, 0, 0, 0, 0],                // couplings: a slot
    [44914, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4485, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [34545, 0, 0, 0, 0, 0],                 // couplings: a link
    [2618, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [27655, 0, 0, 0, 0, 0],                 // couplings: a part
    [721, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [30194, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [5202, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [21898, 1718, 947, 0, 0, 0],            // islands
    [12872, 490, -2561, 0, 0, 0],           // islands, a vector
    [4221, 198, -62, 0, 0, 0],              // islands, an iteration
    [219, 0, 0, 0, 0, 0],                   // islands: a part
    [1510, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
