//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-392, 0, 0, 10034, 1, 0],               // any sweeps
    [98, 0, 0, 28819, 0, 0],                 // a sweep
    [23731, 6778, 1102, 22755, 13472, 0],    // a stored vector
    [3667, 782, 554, 0, 0, 0],               // a pair of them
    [1850, 389, 276, 0, 0, 0],               // a vector and iteration
    [3351, 2297, -7, 0, 0, 0],               // translations
    [1056, 940, 3, 0, 0, 0],                 // translations, a vector
    [527, 402, 2, 0, 0, 0],                  // translations, an iteration
    [2788, 608, 367, 0, 0, 0],               // colliders, a vector
    [-57, 400, 1, 0, 0, 0],                  // colliders, an iteration
    [1230, 11658, -1, 0, 0, 0],              // a collider
    [501, 0, 0, 0, 0, 0],                    // a pin
    [5107, 974, 287, 22264, 13485, 0],       // pins or colliders that move
    [2672, 934, 2, 22111, 13473, 0],         // newmark
    [383, 450, 1, 0, 0, 0],                  // forces
    [12292, 4634, 83, 22510, 13473, 0],      // start from velocity
    [12147, 4666, 83, 22510, 13473, 0],      // start from velocity and force
    [14528, 4456, 360, 22571, 13472, 0],     // start from rest
    [-7424, -3316, 191, 0, 0, 0],            // a past velocity
    [-23153, -9718, 574, 0, 0, 0],           // rotations
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
    [14640, 3306, 437, 58165, 13113, 0],     // identity: step
    [23441, 5280, 991, 101471, 44969, 0],    // identity: step with colliders
    [11172, 1745, 829, 22326, 13472, 0],     // identity: iteration
    [14736, 3338, 437, 58165, 13113, 0],     // mass: step
    [23537, 5312, 991, 101471, 44969, 0],    // mass: step with colliders
    [11172, 1745, 829, 22326, 13472, 0],     // mass: iteration
    [15317, 5026, 437, 73224, 25001, 0],     // jacobi: step
    [23708, 6727, 993, 101434, 44969, 0],    // jacobi: step with colliders
    [11212, 1742, 829, 22335, 13472, 0],     // jacobi: iteration
    [15415, 6186, 438, 79189, 31497, 0],     // block-jacobi: step
    [23489, 8000, 991, 101471, 44969, 0],    // block-jacobi: step with colliders
    [11171, 1745, 829, 22326, 13472, 0],     // block-jacobi: iteration
    [14387, 7445, 277, 72898, 31529, 0],     // warped: step
    [23200, 9419, 830, 116205, 63385, 0],    // warped: step with colliders
    [13657, 5064, 66, 18397, 13472, 1615],   // warped: iteration
    [14386, 7445, 277, 72898, 31529, 0],     // warped-half: step
    [23203, 9419, 831, 116204, 63385, 0],    // warped-half: step with colliders
    [12315, 6264, 823, 22296, 13472, 1988],  // warped-half: iteration
    [12776, 1890, 250, 58121, 13113, 0],     // laplacian: step
    [21590, 3863, 804, 101428, 44969, 0],    // laplacian: step with colliders
    [14188, 3393, -167, 17199, 13472, 1290], // laplacian: iteration
    [12776, 1890, 250, 58121, 13113, 0],     // laplacian-half: step
    [21590, 3863, 804, 101428, 44969, 0],    // laplacian-half: step with colliders
    [14052, 3514, -88, 17605, 13472, 1328],  // laplacian-half: iteration
    [35623, 22159, 343, 85039, 31451, 0],    // two-level: step
    [43891, 23961, 895, 107354, 44915, 0],   // two-level: step with colliders
    [14147, 3882, 833, 22382, 13471, 0],     // two-level: iteration
];

pub(super) const X86_64: Table = [
    [-318, 0, 0, 9849, 10, 0],               // any sweeps
    [120, 0, 0, 10476, 3, 0],                // a sweep
    [26075, 5203, 937, 10150, 11406, 0],     // a stored vector
    [2411, 385, 373, 0, 0, 0],               // a pair of them
    [1224, 191, 187, 0, 0, 0],               // a vector and iteration
    [4872, 1683, 128, 0, 0, 0],              // translations
    [1586, 581, 24, 0, 0, 0],                // translations, a vector
    [819, 232, 13, 0, 0, 0],                 // translations, an iteration
    [2036, 268, 275, 0, 0, 0],               // colliders, a vector
    [635, 378, 135, 0, 0, 0],                // colliders, an iteration
    [1266, 11927, 2, 0, 0, 0],               // a collider
    [370, 0, 0, 0, 0, 0],                    // a pin
    [6150, 693, 316, 10122, 11432, 0],       // pins or colliders that move
    [4915, 863, 81, 10076, 11414, 0],        // newmark
    [718, 339, 18, 0, 0, 0],                 // forces
    [17647, 3778, 391, 10106, 11416, 0],     // start from velocity
    [17679, 3790, 417, 10120, 11416, 0],     // start from velocity and force
    [18429, 3492, 466, 10067, 11417, 0],     // start from rest
    [-12214, -2668, 41, 0, 0, 0],            // a past velocity
    [-36582, -7837, -286, 0, 0, 0],          // rotations
    [628, -3, 1, 0, 0, 0],                   // held by pins
    [10402, 2087, 924, 0, 0, 0],             // coarse: an application more
    [-18633, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [35109, 0, 0, 0, 0, 0],                  // coarse: its square
    [863, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29150, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42551, 0, 0, 0, 0, 0],                  // coarse: a product
    [10547, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16442, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1168, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [24148, 3417, -1, 23271, 22013, 0],      // identity: step
    [33388, 4665, 468, 42911, 44735, 0],     // identity: step with colliders
    [10657, 1082, 679, 10144, 11412, 0],     // identity: iteration
    [24149, 3481, -1, 23271, 22013, 0],      // mass: step
    [33389, 4729, 468, 42911, 44735, 0],     // mass: step with colliders
    [10657, 1082, 679, 10144, 11412, 0],     // mass: iteration
    [25088, 4833, -5, 29456, 28432, 0],      // jacobi: step
    [34053, 5804, 470, 42975, 44725, 0],     // jacobi: step with colliders
    [10605, 1086, 680, 10132, 11414, 0],     // jacobi: iteration
    [24876, 6476, -4, 32738, 33343, 0],      // block-jacobi: step
    [33419, 7594, 467, 42909, 44731, 0],     // block-jacobi: step with colliders
    [10670, 1081, 679, 10146, 11412, 0],     // block-jacobi: iteration
    [16775, 7001, 3457, 30914, 33421, 0],    // warped: step
    [25869, 8259, 3927, 50524, 56149, 0],    // warped: step with colliders
    [17545, 4830, 1335, 9906, 11405, 1138],  // warped: iteration
    [16785, 7000, 3457, 30916, 33421, 0],    // warped-half: step
    [25845, 8261, 3927, 50517, 56150, 0],    // warped-half: step with colliders
    [16290, 5937, 2075, 13707, 11406, 1493], // warped-half: iteration
    [21794, 1861, -240, 23212, 22016, 0],    // laplacian: step
    [30902, 3118, 229, 42826, 44741, 0],     // laplacian: step with colliders
    [13899, 3160, 457, 8224, 11407, 843],    // laplacian: iteration
    [21796, 1861, -240, 23213, 22016, 0],    // laplacian-half: step
    [30896, 3119, 229, 42824, 44741, 0],     // laplacian-half: step with colliders
    [13716, 3296, 567, 8785, 11407, 891],    // laplacian-half: iteration
    [44784, 23987, -104, 39069, 33278, 0],   // two-level: step
    [53501, 25086, 369, 49292, 44669, 0],    // two-level: step with colliders
    [10007, 3306, 677, 10187, 11397, 0],     // two-level: iteration
];

pub(super) const AARCH64: Table = [
    [-174, 0, 0, 7490, 15, 0],              // any sweeps
    [86, 0, 0, 6666, 1, 0],                 // a sweep
    [24726, 3901, 1616, 8146, 9691, 0],     // a stored vector
    [1948, 298, 475, 0, 0, 0],              // a pair of them
    [995, 147, 238, 0, 0, 0],               // a vector and iteration
    [5756, 1029, 447, 0, 0, 0],             // translations
    [2479, 451, 206, 0, 0, 0],              // translations, a vector
    [1288, 181, 106, 0, 0, 0],              // translations, an iteration
    [1659, 212, 350, 0, 0, 0],              // colliders, a vector
    [943, 189, 197, 0, 0, 0],               // colliders, an iteration
    [940, 9897, -2, 0, 0, 0],               // a collider
    [567, 0, 0, 0, 0, 0],                   // a pin
    [5684, 385, 608, 7802, 9711, 0],        // pins or colliders that move
    [6896, 310, 469, 8137, 9698, 0],        // newmark
    [1293, 144, 154, 0, 0, 0],              // forces
    [18808, 2522, 1108, 7891, 9701, 0],     // start from velocity
    [18946, 2524, 1151, 7908, 9701, 0],     // start from velocity and force
    [18111, 2453, 1077, 7787, 9702, 0],     // start from rest
    [-12232, -1979, -206, 0, 0, 0],         // a past velocity
    [-37079, -5692, -1140, 0, 0, 0],        // rotations
    [484, -3, 2, 0, 0, 0],                  // held by pins
    [6080, 1857, 766, 0, 0, 0],             // coarse: an application more
    [-4498, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24807, 0, 0, 0, 0, 0],                 // coarse: its square
    [778, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22433, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [33044, 0, 0, 0, 0, 0],                 // coarse: a product
    [7474, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13782, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [908, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [21192, 2361, 1189, 16885, 18602, 0],   // identity: step
    [30704, 3202, 1982, 32434, 37978, 0],   // identity: step with colliders
    [11075, 558, 1099, 8147, 9697, 0],      // identity: iteration
    [21225, 2393, 1189, 16885, 18602, 0],   // mass: step
    [30736, 3234, 1982, 32434, 37978, 0],   // mass: step with colliders
    [11075, 558, 1099, 8147, 9697, 0],      // mass: iteration
    [23273, 3384, 1288, 22061, 23503, 0],   // jacobi: step
    [30432, 4155, 1975, 32315, 37971, 0],   // jacobi: step with colliders
    [10905, 572, 1097, 8113, 9699, 0],      // jacobi: iteration
    [21935, 4684, 1189, 24319, 28301, 0],   // block-jacobi: step
    [30714, 5395, 1981, 32431, 37975, 0],   // block-jacobi: step with colliders
    [11095, 557, 1099, 8151, 9697, 0],      // block-jacobi: iteration
    [23187, 5776, 1016, 22297, 28520, 0],   // warped: step
    [32483, 6632, 1810, 37803, 47902, 0],   // warped: step with colliders
    [20073, 2933, 2283, 8980, 9692, 827],   // warped: iteration
    [23209, 5774, 1016, 22303, 28520, 0],   // warped-half: step
    [32426, 6637, 1810, 37790, 47903, 0],   // warped-half: step with colliders
    [18729, 4192, 3070, 13024, 9692, 1211], // warped-half: iteration
    [20281, 951, 1015, 16920, 18606, 0],    // laplacian: step
    [29587, 1808, 1806, 32428, 37984, 0],   // laplacian: step with colliders
    [16048, 1962, 1425, 7561, 9693, 635],   // laplacian: iteration
    [20286, 951, 1015, 16922, 18606, 0],    // laplacian-half: step
    [29571, 1809, 1806, 32424, 37984, 0],   // laplacian-half: step with colliders
    [15836, 2191, 1553, 8220, 9693, 701],   // laplacian-half: iteration
    [31850, 18146, 1122, 30084, 28234, 0],  // two-level: step
    [40921, 18830, 1924, 38265, 37912, 0],  // two-level: step with colliders
    [10307, 2529, 1095, 8183, 9683, 0],     // two-level: iteration
];
