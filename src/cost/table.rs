//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-392, 0, 0, 10034, 1, 0],               // any sweeps
    [98, 0, 0, 28819, 0, 0],                 // a sweep
    [23791, 6960, 1101, 22755, 13472, 0],    // a stored vector
    [3667, 782, 554, 0, 0, 0],               // a pair of them
    [1850, 389, 276, 0, 0, 0],               // a vector and iteration
    [3351, 2297, -7, 0, 0, 0],               // translations
    [1056, 940, 3, 0, 0, 0],                 // translations, a vector
    [527, 402, 2, 0, 0, 0],                  // translations, an iteration
    [2788, 608, 367, 0, 0, 0],               // colliders, a vector
    [-57, 400, 1, 0, 0, 0],                  // colliders, an iteration
    [733, 10312, 3, 0, 0, 0],                // a collider
    [501, 0, 0, 0, 0, 0],                    // a pin
    [5108, 974, 287, 22265, 13485, 0],       // pins or colliders that move
    [2673, 934, 2, 22111, 13473, 0],         // newmark
    [383, 450, 1, 0, 0, 0],                  // forces
    [12352, 4816, 83, 22510, 13473, 0],      // start from velocity
    [12208, 4848, 83, 22510, 13473, 0],      // start from velocity and force
    [14589, 4638, 360, 22571, 13472, 0],     // start from rest
    [-7484, -3499, 192, 0, 0, 0],            // a past velocity
    [-23331, -10265, 576, 0, 0, 0],          // rotations
    [692, -4, 0, 0, 0, 0],                   // held by pins
    [10190, 1981, 1174, 0, 0, 0],            // coarse: an application more
    [3676, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21587, 0, 0, 0, 0, 0],                  // coarse: its square
    [4582, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33087, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111647, 0, 0, 0, 0, 0],                 // coarse: a product
    [12263, 0, 0, 0, 0, 0],                  // coarse: a sum
    [12239, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3357, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [14565, 3124, 438, 58164, 13113, 0],     // identity: step
    [23862, 6444, 987, 101471, 44969, 0],    // identity: step with colliders
    [11172, 1745, 829, 22326, 13472, 0],     // identity: iteration
    [14661, 3156, 438, 58164, 13113, 0],     // mass: step
    [23958, 6476, 987, 101471, 44969, 0],    // mass: step with colliders
    [11172, 1745, 829, 22326, 13472, 0],     // mass: iteration
    [15241, 4844, 438, 73224, 25001, 0],     // jacobi: step
    [24127, 7891, 989, 101434, 44969, 0],    // jacobi: step with colliders
    [11212, 1742, 829, 22335, 13472, 0],     // jacobi: iteration
    [15339, 6004, 438, 79188, 31497, 0],     // block-jacobi: step
    [23911, 9164, 987, 101471, 44969, 0],    // block-jacobi: step with colliders
    [11171, 1745, 829, 22326, 13472, 0],     // block-jacobi: iteration
    [14311, 7263, 277, 72898, 31529, 0],     // warped: step
    [23621, 10582, 826, 116204, 63385, 0],   // warped: step with colliders
    [13657, 5064, 66, 18397, 13472, 1615],   // warped: iteration
    [14310, 7263, 277, 72898, 31529, 0],     // warped-half: step
    [23624, 10582, 827, 116204, 63385, 0],   // warped-half: step with colliders
    [12315, 6264, 823, 22296, 13472, 1988],  // warped-half: iteration
    [12701, 1708, 250, 58121, 13113, 0],     // laplacian: step
    [22011, 5027, 800, 101427, 44969, 0],    // laplacian: step with colliders
    [14188, 3393, -167, 17199, 13472, 1290], // laplacian: iteration
    [12700, 1708, 250, 58121, 13113, 0],     // laplacian-half: step
    [22011, 5027, 800, 101427, 44969, 0],    // laplacian-half: step with colliders
    [14052, 3514, -88, 17605, 13472, 1328],  // laplacian-half: iteration
    [35547, 21976, 343, 85039, 31451, 0],    // two-level: step
    [44312, 25124, 891, 107354, 44915, 0],   // two-level: step with colliders
    [14147, 3882, 833, 22382, 13471, 0],     // two-level: iteration
    [497, 1346, -5, 0, 0, 0],                // a sphere
    [3736, 5007, 1, 0, 0, 0],                // a capsule
    [3753, 9710, 6, 0, 0, 0],                // a box
    [3754, 9902, 6, 0, 0, 0],                // a height field
    [187, 11101, 8, 0, 0, 0],                // a frame
    [3867, 0, 0, 70590, 14320, 0],           // plastic flow
    [6012, 0, 0, 237408, 608, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [13776, 4141, 3462, 18059, 13474, 0],    // couplings: step
    [-9738, 954, 1048, 18122, 18405, 0],     // couplings: diagonal where none was
    [17587, -1219, -1763, 9190, 8262, 0],    // couplings: diagonal for jacobi
    [10742, -120, -2307, 92, 1601, 0],       // couplings: beside colliders
    [-42987, 0, 0, 0, 0, 0],                 // couplings: a rigid body and collider
    [583, 47, -519, 0, 0, 0],                // couplings: an iteration
    [3808, -13, 1190, 0, 0, 0],              // couplings: an iteration with a factor
    [142884, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46059, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4877, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [47393, 0, 0, 0, 0, 0],                  // couplings: a link
    [3715, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [11272, 0, 0, 0, 0, 0],                  // couplings: a part
    [905, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [50987, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5680, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [62411, 2352, 1829, 0, 0, 0],            // islands
    [45715, 1061, -3435, 0, 0, 0],           // islands, a vector
    [20728, 429, -165, 0, 0, 0],             // islands, an iteration
    [3725, 0, 0, 0, 0, 0],                   // islands: a part
    [806, 0, 0, 0, 0, 0],                    // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-319, 0, 0, 9849, 10, 0],               // any sweeps
    [120, 0, 0, 10476, 3, 0],                // a sweep
    [26145, 5336, 940, 10149, 11422, 0],     // a stored vector
    [2411, 385, 373, 0, 0, 0],               // a pair of them
    [1224, 191, 187, 0, 0, 0],               // a vector and iteration
    [4855, 1683, 128, 0, 0, 0],              // translations
    [1586, 581, 24, 0, 0, 0],                // translations, a vector
    [819, 232, 13, 0, 0, 0],                 // translations, an iteration
    [2036, 268, 275, 0, 0, 0],               // colliders, a vector
    [635, 378, 135, 0, 0, 0],                // colliders, an iteration
    [869, 10710, 5, 0, 0, 0],                // a collider
    [370, 0, 0, 0, 0, 0],                    // a pin
    [6137, 695, 315, 10116, 11448, 0],       // pins or colliders that move
    [4896, 864, 81, 10072, 11430, 0],        // newmark
    [718, 339, 18, 0, 0, 0],                 // forces
    [17696, 3916, 390, 10101, 11432, 0],     // start from velocity
    [17728, 3929, 416, 10115, 11432, 0],     // start from velocity and force
    [18462, 3630, 464, 10061, 11433, 0],     // start from rest
    [-12273, -2804, 42, 0, 0, 0],            // a past velocity
    [-36816, -8229, -292, 0, 0, 0],          // rotations
    [628, -3, 1, 0, 0, 0],                   // held by pins
    [10397, 2087, 922, 0, 0, 0],             // coarse: an application more
    [-17922, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34966, 0, 0, 0, 0, 0],                  // coarse: its square
    [863, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29149, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42552, 0, 0, 0, 0, 0],                  // coarse: a product
    [10547, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16442, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [24140, 3280, 1, 23305, 21999, 0],       // identity: step
    [33777, 5730, 467, 42913, 44736, 0],     // identity: step with colliders
    [10673, 1082, 679, 10144, 11428, 0],     // identity: iteration
    [24141, 3344, 1, 23305, 21998, 0],       // mass: step
    [33777, 5794, 467, 42913, 44736, 0],     // mass: step with colliders
    [10673, 1082, 679, 10144, 11428, 0],     // mass: iteration
    [25089, 4695, -3, 29491, 28417, 0],      // jacobi: step
    [34481, 6865, 469, 42985, 44726, 0],     // jacobi: step with colliders
    [10623, 1086, 680, 10133, 11430, 0],     // jacobi: iteration
    [24867, 6339, -2, 32739, 33328, 0],      // block-jacobi: step
    [33807, 8659, 466, 42911, 44733, 0],     // block-jacobi: step with colliders
    [10685, 1081, 679, 10146, 11428, 0],     // block-jacobi: iteration
    [16751, 6864, 3458, 30947, 33422, 0],    // warped: step
    [26242, 9324, 3926, 50525, 56167, 0],    // warped: step with colliders
    [17650, 4826, 1349, 9913, 11421, 1138],  // warped: iteration
    [16761, 6863, 3458, 30950, 33422, 0],    // warped-half: step
    [26218, 9326, 3926, 50519, 56167, 0],    // warped-half: step with colliders
    [16395, 5934, 2089, 13715, 11422, 1493], // warped-half: iteration
    [21769, 1724, -238, 23246, 22001, 0],    // laplacian: step
    [31275, 4183, 227, 42827, 44743, 0],     // laplacian: step with colliders
    [13937, 3156, 461, 8228, 11423, 843],    // laplacian: iteration
    [21771, 1724, -238, 23246, 22001, 0],    // laplacian-half: step
    [31269, 4183, 228, 42826, 44743, 0],     // laplacian-half: step with colliders
    [13753, 3292, 571, 8789, 11423, 891],    // laplacian-half: iteration
    [44368, 23850, -102, 39071, 33263, 0],   // two-level: step
    [53482, 26151, 368, 49294, 44670, 0],    // two-level: step with colliders
    [10023, 3306, 677, 10187, 11413, 0],     // two-level: iteration
    [398, 1202, -3, 0, 0, 0],                // a sphere
    [-1621, 5028, -583, 0, 0, 0],            // a capsule
    [-1577, 9060, -579, 0, 0, 0],            // a box
    [-1575, 9252, -579, 0, 0, 0],            // a height field
    [120, 19603, 21, 0, 0, 0],               // a frame
    [3919, 0, 0, 24075, 12096, 0],           // plastic flow
    [6858, 0, 0, 47577, 5345, 0],            // fracture
    [512, 0, 0, 4606, 1, 0],                 // fracture: a place
    [-77058, 7355, 8020, -2642, 4677, 0],    // couplings: step
    [5184, -250, 132, 10667, 10789, 0],      // couplings: diagonal where none was
    [26317, -1986, -1301, 9050, 6891, 0],    // couplings: diagonal for jacobi
    [18757, -986, -334, 3041, 477, 0],       // couplings: beside colliders
    [-45282, 0, 0, 0, 0, 0],                 // couplings: a rigid body and collider
    [-207, 41, -126, 0, 0, 0],               // couplings: an iteration
    [-1184, 58, -444, 0, 0, 0],              // couplings: an iteration with a factor
    [130170, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54707, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4762, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [39276, 0, 0, 0, 0, 0],                  // couplings: a link
    [3111, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [787, 0, 0, 0, 0, 0],                    // couplings: a part
    [658, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [59987, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [6277, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [26358, 2019, -599, 0, 0, 0],            // islands
    [16195, 590, -2329, 0, 0, 0],            // islands, a vector
    [5382, 254, 140, 0, 0, 0],               // islands, an iteration
    [2215, 0, 0, 0, 0, 0],                   // islands: a part
    [683, 0, 0, 0, 0, 0],                    // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-178, 0, 0, 7490, 14, 0],              // any sweeps
    [87, 0, 0, 6666, 1, 0],                 // a sweep
    [24768, 4012, 1615, 8142, 9691, 0],     // a stored vector
    [1947, 298, 475, 0, 0, 0],              // a pair of them
    [995, 147, 238, 0, 0, 0],               // a vector and iteration
    [5754, 1029, 447, 0, 0, 0],             // translations
    [2479, 451, 206, 0, 0, 0],              // translations, a vector
    [1288, 181, 106, 0, 0, 0],              // translations, an iteration
    [1659, 212, 350, 0, 0, 0],              // colliders, a vector
    [942, 189, 197, 0, 0, 0],               // colliders, an iteration
    [695, 8855, 7, 0, 0, 0],                // a collider
    [567, 0, 0, 0, 0, 0],                   // a pin
    [5588, 392, 607, 7781, 9711, 0],        // pins or colliders that move
    [6835, 315, 469, 8124, 9698, 0],        // newmark
    [1293, 144, 154, 0, 0, 0],              // forces
    [18804, 2637, 1106, 7877, 9701, 0],     // start from velocity
    [18941, 2640, 1150, 7894, 9701, 0],     // start from velocity and force
    [18107, 2568, 1075, 7773, 9702, 0],     // start from rest
    [-12294, -2089, -205, 0, 0, 0],         // a past velocity
    [-37265, -6021, -1137, 0, 0, 0],        // rotations
    [484, -3, 2, 0, 0, 0],                  // held by pins
    [6059, 1858, 761, 0, 0, 0],             // coarse: an application more
    [-4498, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24807, 0, 0, 0, 0, 0],                 // coarse: its square
    [778, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22433, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [33044, 0, 0, 0, 0, 0],                 // coarse: a product
    [7474, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13782, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [908, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [21172, 2250, 1190, 16889, 18603, 0],   // identity: step
    [30928, 4133, 1974, 32438, 37978, 0],   // identity: step with colliders
    [11074, 558, 1099, 8147, 9697, 0],      // identity: iteration
    [21204, 2282, 1190, 16889, 18603, 0],   // mass: step
    [30960, 4165, 1974, 32438, 37978, 0],   // mass: step with colliders
    [11075, 558, 1099, 8147, 9697, 0],      // mass: iteration
    [23278, 3270, 1290, 22071, 23503, 0],   // jacobi: step
    [30797, 5074, 1969, 32348, 37971, 0],   // jacobi: step with colliders
    [10912, 571, 1097, 8114, 9699, 0],      // jacobi: iteration
    [21915, 4573, 1190, 24323, 28301, 0],   // block-jacobi: step
    [30938, 6326, 1973, 32435, 37975, 0],   // block-jacobi: step with colliders
    [11094, 557, 1099, 8151, 9697, 0],      // block-jacobi: iteration
    [23166, 5665, 1017, 22301, 28520, 0],   // warped: step
    [32707, 7563, 1802, 37807, 47902, 0],   // warped: step with colliders
    [20073, 2933, 2283, 8980, 9692, 827],   // warped: iteration
    [23188, 5663, 1017, 22307, 28520, 0],   // warped-half: step
    [32650, 7568, 1802, 37794, 47903, 0],   // warped-half: step with colliders
    [18729, 4192, 3070, 13024, 9692, 1211], // warped-half: iteration
    [20260, 840, 1016, 16924, 18606, 0],    // laplacian: step
    [29811, 2738, 1798, 32431, 37984, 0],   // laplacian: step with colliders
    [16048, 1962, 1425, 7561, 9693, 635],   // laplacian: iteration
    [20265, 839, 1016, 16926, 18606, 0],    // laplacian-half: step
    [29795, 2739, 1798, 32428, 37985, 0],   // laplacian-half: step with colliders
    [15835, 2191, 1553, 8220, 9693, 701],   // laplacian-half: iteration
    [31830, 18034, 1123, 30088, 28234, 0],  // two-level: step
    [41143, 19761, 1916, 38269, 37913, 0],  // two-level: step with colliders
    [10307, 2529, 1095, 8183, 9683, 0],     // two-level: iteration
    [247, 1042, -9, 0, 0, 0],               // a sphere
    [-386, 4319, -472, 0, 0, 0],            // a capsule
    [-353, 7487, -467, 0, 0, 0],            // a box
    [-350, 7775, -467, 0, 0, 0],            // a height field
    [170, 14794, 6, 0, 0, 0],               // a frame
    [4630, 0, 0, 18518, 10264, 0],          // plastic flow
    [4364, 0, 0, 29255, 4583, 0],           // fracture
    [449, 0, 0, 3582, 1, 0],                // fracture: a place
    [-30355, 3009, 3104, 6646, 5322, 0],    // couplings: step
    [21808, -1041, -2821, 10642, 14921, 0], // couplings: diagonal where none was
    [34250, -2285, -3748, 9206, 12331, 0],  // couplings: diagonal for jacobi
    [22626, -1488, -3024, 4179, 5258, 0],   // couplings: beside colliders
    [-37976, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-1200, 76, -470, 0, 0, 0],             // couplings: an iteration
    [179, 9, -936, 0, 0, 0],                // couplings: an iteration with a factor
    [117773, 0, 0, 0, 0, 0],                // couplings: a slot
    [44913, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4490, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [35929, 0, 0, 0, 0, 0],                 // couplings: a link
    [2519, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [27661, 0, 0, 0, 0, 0],                 // couplings: a part
    [717, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [31987, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [5276, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [23164, 1701, 702, 0, 0, 0],            // islands
    [14722, 490, -2555, 0, 0, 0],           // islands, a vector
    [5207, 206, 29, 0, 0, 0],               // islands, an iteration
    [466, 0, 0, 0, 0, 0],                   // islands: a part
    [1448, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
