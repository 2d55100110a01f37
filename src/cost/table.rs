//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-360, 0, 0, 10685, -4, 0],             // any sweeps
    [86, 0, 0, 32785, 1, 0],                // a sweep
    [10725, 4238, 311, 25543, 12058, 0],    // a stored vector
    [1879, 1117, 119, 0, 0, 0],             // a pair of them
    [971, 556, 59, 0, 0, 0],                // a vector and iteration
    [1980, 2300, -7, 0, 0, 0],              // translations
    [939, 939, 2, 0, 0, 0],                 // translations, a vector
    [526, 402, 1, 0, 0, 0],                 // translations, an iteration
    [1502, 939, 61, 0, 0, 0],               // colliders, a vector
    [1502, 939, 61, 0, 0, 0],               // colliders, an iteration
    [499, 9898, -1, 0, 0, 0],               // a collider
    [972, 0, 0, 0, 0, 0],                   // a pin
    [2879, 1236, 77, 25516, 12066, 0],      // pins or colliders that move
    [1966, 977, 16, 25408, 12059, 0],       // newmark
    [439, 450, 0, 0, 0, 0],                 // forces
    [2210, 1797, 72, 25471, 12059, 0],      // start from velocity
    [1922, 1829, 72, 25471, 12059, 0],      // start from velocity and force
    [1922, 1829, 72, 25471, 12059, 0],      // start from rest
    [-2299, -108, -1, 0, 0, 0],             // a past velocity
    [-7273, -45, -9, 0, 0, 0],              // rotations
    [193, -3, -1, 0, 0, 0],                 // held by pins
    [9414, 2002, 972, 0, 0, 0],             // coarse: an application more
    [3931, 0, 0, 0, 0, 0],                  // coarse: an aggregate
    [19678, 0, 0, 0, 0, 0],                 // coarse: its square
    [4595, 0, 0, 0, 0, 0],                  // coarse: its cube
    [55739, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [105943, 0, 0, 0, 0, 0],                // coarse: a product
    [12651, 0, 0, 0, 0, 0],                 // coarse: a sum
    [8276, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3350, 0, 0, 0, 0, 0],                  // coarse: its square, an application
    [19259, 6386, 127, 63882, 11174, 0],    // identity: step
    [25099, 8142, 274, 118659, 50841, 0],   // identity: step with colliders
    [5129, 2142, 108, 25451, 12058, 0],     // identity: iteration
    [19339, 6514, 127, 63882, 11174, 0],    // mass: step
    [25179, 8270, 274, 118659, 50841, 0],   // mass: step with colliders
    [5129, 2142, 108, 25451, 12058, 0],     // mass: iteration
    [19774, 8073, 140, 80634, 21630, 0],    // jacobi: step
    [25329, 9571, 274, 118672, 50842, 0],   // jacobi: step with colliders
    [5128, 2142, 108, 25452, 12057, 0],     // jacobi: iteration
    [19785, 9599, 143, 93204, 38783, 0],    // block-jacobi: step
    [25146, 11198, 274, 118659, 50842, 0],  // block-jacobi: step with colliders
    [5127, 2142, 108, 25451, 12058, 0],     // block-jacobi: iteration
    [20440, 9042, 170, 85789, 38943, 0],    // warped: step
    [26297, 10797, 317, 140567, 78610, 0],  // warped: step with colliders
    [7743, 4731, -714, 21219, 12058, 1690], // warped: iteration
    [20436, 9042, 170, 85789, 38943, 0],    // warped-half: step
    [26305, 10797, 317, 140567, 78610, 0],  // warped-half: step with colliders
    [4840, 7704, 1027, 30182, 12058, 2591], // warped-half: iteration
    [19063, 5122, 127, 63882, 11174, 0],    // laplacian: step
    [24918, 6877, 274, 118660, 50841, 0],   // laplacian: step with colliders
    [8230, 3019, -911, 20206, 12058, 1338], // laplacian: iteration
    [19062, 5122, 127, 63882, 11174, 0],    // laplacian-half: step
    [24920, 6877, 274, 118660, 50841, 0],   // laplacian-half: step with colliders
    [7825, 3395, -677, 21409, 12058, 1455], // laplacian-half: iteration
    [151968, 24404, 19, 98709, 38720, 0],   // two-level: step
    [157452, 25996, 142, 124187, 50767, 0], // two-level: step with colliders
    [9312, 4284, 107, 25499, 12055, 0],     // two-level: iteration
];

pub(super) const X86_64: Table = [
    [-235, 0, 0, 9896, 10, 0],               // any sweeps
    [101, 0, 0, 10956, 3, 0],                // a sweep
    [13712, 2594, 815, 10713, 11029, 0],     // a stored vector
    [2281, 384, 425, 0, 0, 0],               // a pair of them
    [1164, 190, 212, 0, 0, 0],               // a vector and iteration
    [3137, 1732, 126, 0, 0, 0],              // translations
    [1593, 581, 24, 0, 0, 0],                // translations, a vector
    [917, 232, 13, 0, 0, 0],                 // translations, an iteration
    [2089, 267, 322, 0, 0, 0],               // colliders, a vector
    [2089, 267, 322, 0, 0, 0],               // colliders, an iteration
    [690, 10296, 2, 0, 0, 0],                // a collider
    [772, 0, 0, 0, 0, 0],                    // a pin
    [5168, 675, 321, 10638, 11048, 0],       // pins or colliders that move
    [5059, 841, 102, 10630, 11035, 0],       // newmark
    [811, 339, 7, 0, 0, 0],                  // forces
    [5086, 1181, 436, 10637, 11039, 0],      // start from velocity
    [5087, 1188, 471, 10654, 11039, 0],      // start from velocity and force
    [5087, 1188, 471, 10654, 11039, 0],      // start from rest
    [-1913, -94, 3, 0, 0, 0],                // a past velocity
    [-4649, -102, -425, 0, 0, 0],            // rotations
    [203, -3, 0, 0, 0, 0],                   // held by pins
    [7079, 2101, 732, 0, 0, 0],              // coarse: an application more
    [-9457, 0, 0, 0, 0, 0],                  // coarse: an aggregate
    [31416, 0, 0, 0, 0, 0],                  // coarse: its square
    [915, 0, 0, 0, 0, 0],                    // coarse: its cube
    [17213, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [41222, 0, 0, 0, 0, 0],                  // coarse: a product
    [10795, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16450, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1167, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [32667, 5715, 2, 23155, 21009, 0],       // identity: step
    [40138, 6502, 271, 44344, 45686, 0],     // identity: step with colliders
    [7749, 1082, 525, 10635, 11035, 0],      // identity: iteration
    [32669, 5811, 2, 23155, 21008, 0],       // mass: step
    [40139, 6598, 270, 44343, 45686, 0],     // mass: step with colliders
    [7749, 1082, 525, 10635, 11035, 0],      // mass: iteration
    [33080, 7133, 14, 29686, 26988, 0],      // jacobi: step
    [39903, 7694, 261, 44267, 45680, 0],     // jacobi: step with colliders
    [7717, 1083, 526, 10632, 11036, 0],      // jacobi: iteration
    [33057, 8702, 20, 33779, 34667, 0],      // block-jacobi: step
    [40172, 9367, 268, 44342, 45682, 0],     // block-jacobi: step with colliders
    [7751, 1082, 525, 10635, 11035, 0],      // block-jacobi: iteration
    [26018, 8174, 3576, 32188, 35244, 0],    // warped: step
    [33517, 8961, 3848, 53377, 59925, 0],    // warped: step with colliders
    [15034, 4406, 1168, 10443, 11028, 1130], // warped: iteration
    [26014, 8174, 3576, 32188, 35243, 0],    // warped-half: step
    [33526, 8960, 3849, 53377, 59925, 0],    // warped-half: step with colliders
    [12964, 6462, 2492, 17249, 11029, 1777], // warped-half: iteration
    [31401, 4336, -142, 23094, 21011, 0],    // laplacian: step
    [38885, 5123, 129, 44284, 45691, 0],     // laplacian: step with colliders
    [11210, 2750, 312, 8881, 11030, 818],    // laplacian: iteration
    [31400, 4336, -142, 23094, 21011, 0],    // laplacian-half: step
    [38887, 5122, 129, 44284, 45691, 0],     // laplacian-half: step with colliders
    [10921, 3088, 521, 9954, 11030, 921],    // laplacian-half: iteration
    [347755, 26193, -107, 39249, 34540, 0],  // two-level: step
    [354968, 26849, 140, 49838, 45553, 0],   // two-level: step with colliders
    [7075, 3309, 518, 10673, 11017, 0],      // two-level: iteration
];

pub(super) const AARCH64: Table = [
    [-84, 0, 0, 7547, 19, 0],               // any sweeps
    [70, 0, 0, 6667, 1, 0],                 // a sweep
    [12232, 1993, 1199, 8807, 9452, 0],     // a stored vector
    [1780, 297, 491, 0, 0, 0],              // a pair of them
    [886, 147, 243, 0, 0, 0],               // a vector and iteration
    [4594, 1030, 442, 0, 0, 0],             // translations
    [2424, 451, 208, 0, 0, 0],              // translations, a vector
    [1249, 181, 107, 0, 0, 0],              // translations, an iteration
    [1620, 212, 356, 0, 0, 0],              // colliders, a vector
    [1620, 212, 356, 0, 0, 0],              // colliders, an iteration
    [575, 7896, 2, 0, 0, 0],                // a collider
    [886, 0, 0, 0, 0, 0],                   // a pin
    [5333, 330, 636, 8500, 9469, 0],        // pins or colliders that move
    [7411, 253, 490, 8876, 9458, 0],        // newmark
    [1353, 144, 150, 0, 0, 0],              // forces
    [7025, 551, 919, 8615, 9463, 0],        // start from velocity
    [6960, 555, 958, 8631, 9463, 0],        // start from velocity and force
    [6960, 555, 958, 8631, 9463, 0],        // start from rest
    [-1058, -72, 11, 0, 0, 0],              // a past velocity
    [-2744, 26, -485, 0, 0, 0],             // rotations
    [160, -2, 1, 0, 0, 0],                  // held by pins
    [6340, 1859, 707, 0, 0, 0],             // coarse: an application more
    [-5937, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24233, 0, 0, 0, 0, 0],                 // coarse: its square
    [778, 0, 0, 0, 0, 0],                   // coarse: its cube
    [16580, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [31392, 0, 0, 0, 0, 0],                 // coarse: a product
    [7709, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13782, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [908, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [30753, 3860, 1604, 16936, 18275, 0],   // identity: step
    [38116, 4476, 2096, 34529, 38260, 0],   // identity: step with colliders
    [9070, 484, 895, 8719, 9459, 0],        // identity: iteration
    [30786, 3892, 1604, 16936, 18274, 0],   // mass: step
    [38149, 4508, 2096, 34529, 38260, 0],   // mass: step with colliders
    [9070, 484, 895, 8719, 9459, 0],        // mass: iteration
    [31820, 4909, 1713, 22568, 23156, 0],   // jacobi: step
    [36424, 5532, 2071, 34141, 38256, 0],   // jacobi: step with colliders
    [8945, 494, 895, 8693, 9461, 0],        // jacobi: iteration
    [31351, 6352, 1615, 26018, 28818, 0],   // block-jacobi: step
    [38140, 6845, 2093, 34528, 38256, 0],   // block-jacobi: step with colliders
    [9073, 484, 895, 8718, 9459, 0],        // block-jacobi: iteration
    [32971, 6048, 1560, 24050, 29264, 0],   // warped: step
    [40351, 6664, 2055, 41643, 49254, 0],   // warped: step with colliders
    [18629, 2628, 2122, 9622, 9453, 833],   // warped: iteration
    [32968, 6048, 1560, 24050, 29264, 0],   // warped-half: step
    [40359, 6664, 2056, 41643, 49254, 0],   // warped-half: step with colliders
    [17168, 4116, 3065, 14474, 9453, 1294], // warped-half: iteration
    [30525, 2567, 1543, 16966, 18278, 0],   // laplacian: step
    [37900, 3183, 2036, 34561, 38266, 0],   // laplacian: step with colliders
    [14213, 1660, 1244, 8222, 9454, 622],   // laplacian: iteration
    [30524, 2567, 1543, 16966, 18278, 0],   // laplacian-half: step
    [37902, 3183, 2036, 34561, 38266, 0],   // laplacian-half: step with colliders
    [13967, 1945, 1429, 9172, 9454, 711],   // laplacian-half: iteration
    [44232, 19809, 1485, 30686, 28719, 0],  // two-level: step
    [51130, 20291, 1961, 39228, 38155, 0],  // two-level: step with colliders
    [8235, 2462, 883, 8740, 9441, 0],       // two-level: iteration
];
