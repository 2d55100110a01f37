//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-361, 0, 0, 10685, -4, 0],             // any sweeps
    [86, 0, 0, 32785, 1, 0],                // a sweep
    [10726, 4238, 311, 25544, 12058, 0],    // a stored vector
    [1879, 1117, 119, 0, 0, 0],             // a pair of them
    [971, 556, 59, 0, 0, 0],                // a vector and iteration
    [1978, 2300, -7, 0, 0, 0],              // translations
    [939, 939, 2, 0, 0, 0],                 // translations, a vector
    [526, 402, 1, 0, 0, 0],                 // translations, an iteration
    [1502, 939, 61, 0, 0, 0],               // colliders, a vector
    [499, 9898, -1, 0, 0, 0],               // a collider
    [972, 0, 0, 0, 0, 0],                   // a pin
    [2879, 1236, 77, 25517, 12066, 0],      // pins or colliders that move
    [1966, 977, 16, 25408, 12059, 0],       // newmark
    [439, 450, 0, 0, 0, 0],                 // forces
    [2210, 1797, 72, 25471, 12059, 0],      // start from velocity
    [1922, 1829, 72, 25471, 12059, 0],      // start from velocity and force
    [-2300, -108, -1, 0, 0, 0],             // a past velocity
    [-7275, -45, -9, 0, 0, 0],              // rotations
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
    [19243, 6450, 127, 63882, 11174, 0],    // identity: step
    [25083, 8206, 274, 118659, 50841, 0],   // identity: step with colliders
    [5129, 2142, 108, 25451, 12058, 0],     // identity: iteration
    [19323, 6578, 127, 63882, 11174, 0],    // mass: step
    [25163, 8334, 274, 118659, 50841, 0],   // mass: step with colliders
    [5129, 2142, 108, 25451, 12058, 0],     // mass: iteration
    [19758, 8137, 140, 80634, 21630, 0],    // jacobi: step
    [25313, 9635, 274, 118672, 50842, 0],   // jacobi: step with colliders
    [5128, 2142, 108, 25452, 12057, 0],     // jacobi: iteration
    [19769, 9663, 143, 93204, 38783, 0],    // block-jacobi: step
    [25131, 11262, 274, 118659, 50842, 0],  // block-jacobi: step with colliders
    [5127, 2142, 108, 25451, 12058, 0],     // block-jacobi: iteration
    [20424, 9106, 170, 85789, 38943, 0],    // warped: step
    [26281, 10861, 317, 140567, 78610, 0],  // warped: step with colliders
    [7743, 4730, -714, 21218, 12058, 1690], // warped: iteration
    [20421, 9106, 170, 85789, 38943, 0],    // warped-half: step
    [26289, 10861, 317, 140567, 78610, 0],  // warped-half: step with colliders
    [4840, 7704, 1027, 30182, 12058, 2591], // warped-half: iteration
    [19047, 5186, 127, 63882, 11174, 0],    // laplacian: step
    [24903, 6941, 274, 118660, 50841, 0],   // laplacian: step with colliders
    [8230, 3019, -911, 20205, 12058, 1339], // laplacian: iteration
    [19046, 5186, 127, 63882, 11174, 0],    // laplacian-half: step
    [24904, 6941, 274, 118660, 50841, 0],   // laplacian-half: step with colliders
    [7825, 3395, -677, 21408, 12058, 1455], // laplacian-half: iteration
    [151954, 24467, 19, 98709, 38720, 0],   // two-level: step
    [157437, 26060, 142, 124187, 50767, 0], // two-level: step with colliders
    [9312, 4284, 107, 25499, 12055, 0],     // two-level: iteration
];

pub(super) const X86_64: Table = [
    [-236, 0, 0, 9896, 10, 0],               // any sweeps
    [101, 0, 0, 10956, 3, 0],                // a sweep
    [13697, 2594, 815, 10713, 11013, 0],     // a stored vector
    [2281, 384, 425, 0, 0, 0],               // a pair of them
    [1164, 190, 212, 0, 0, 0],               // a vector and iteration
    [3137, 1732, 127, 0, 0, 0],              // translations
    [1593, 581, 24, 0, 0, 0],                // translations, a vector
    [917, 232, 13, 0, 0, 0],                 // translations, an iteration
    [2089, 267, 322, 0, 0, 0],               // colliders, a vector
    [689, 10280, 2, 0, 0, 0],                // a collider
    [772, 0, 0, 0, 0, 0],                    // a pin
    [5165, 675, 321, 10637, 11032, 0],       // pins or colliders that move
    [5043, 841, 102, 10630, 11019, 0],       // newmark
    [811, 339, 7, 0, 0, 0],                  // forces
    [5086, 1181, 436, 10637, 11023, 0],      // start from velocity
    [5087, 1188, 471, 10654, 11023, 0],      // start from velocity and force
    [-1914, -94, 3, 0, 0, 0],                // a past velocity
    [-4650, -102, -425, 0, 0, 0],            // rotations
    [203, -3, 0, 0, 0, 0],                   // held by pins
    [6830, 2106, 723, 0, 0, 0],              // coarse: an application more
    [-10180, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [31477, 0, 0, 0, 0, 0],                  // coarse: its square
    [915, 0, 0, 0, 0, 0],                    // coarse: its cube
    [17320, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [41200, 0, 0, 0, 0, 0],                  // coarse: a product
    [10533, 0, 0, 0, 0, 0],                  // coarse: a sum
    [16450, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1167, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [32702, 5714, 1, 23156, 21009, 0],       // identity: step
    [40173, 6534, 270, 44344, 45686, 0],     // identity: step with colliders
    [7749, 1082, 525, 10635, 11019, 0],      // identity: iteration
    [32703, 5810, 1, 23155, 21008, 0],       // mass: step
    [40174, 6630, 270, 44344, 45686, 0],     // mass: step with colliders
    [7749, 1082, 525, 10635, 11019, 0],      // mass: iteration
    [33115, 7149, 14, 29687, 27004, 0],      // jacobi: step
    [39938, 7742, 261, 44267, 45680, 0],     // jacobi: step with colliders
    [7718, 1083, 526, 10632, 11020, 0],      // jacobi: iteration
    [33091, 8702, 19, 33780, 34683, 0],      // block-jacobi: step
    [40207, 9399, 268, 44343, 45682, 0],     // block-jacobi: step with colliders
    [7751, 1082, 525, 10635, 11019, 0],      // block-jacobi: iteration
    [26052, 8174, 3576, 32189, 35228, 0],    // warped: step
    [33551, 8992, 3848, 53378, 59909, 0],    // warped: step with colliders
    [15056, 4402, 1172, 10447, 11012, 1130], // warped: iteration
    [26048, 8174, 3576, 32189, 35227, 0],    // warped-half: step
    [33561, 8992, 3848, 53378, 59909, 0],    // warped-half: step with colliders
    [12986, 6458, 2496, 17253, 11013, 1776], // warped-half: iteration
    [31435, 4336, -142, 23094, 21011, 0],    // laplacian: step
    [38919, 5154, 128, 44285, 45691, 0],     // laplacian: step with colliders
    [11189, 2755, 309, 8877, 11014, 818],    // laplacian: iteration
    [31434, 4336, -142, 23094, 21011, 0],    // laplacian-half: step
    [38921, 5154, 128, 44285, 45691, 0],     // laplacian-half: step with colliders
    [10921, 3088, 521, 9954, 11014, 921],    // laplacian-half: iteration
    [348096, 26195, -100, 39242, 34557, 0],  // two-level: step
    [355301, 26884, 147, 49829, 45554, 0],   // two-level: step with colliders
    [7069, 3309, 518, 10672, 11001, 0],      // two-level: iteration
];

pub(super) const AARCH64: Table = [
    [-85, 0, 0, 7547, 19, 0],               // any sweeps
    [70, 0, 0, 6667, 1, 0],                 // a sweep
    [12233, 1993, 1199, 8807, 9452, 0],     // a stored vector
    [1780, 297, 491, 0, 0, 0],              // a pair of them
    [886, 147, 243, 0, 0, 0],               // a vector and iteration
    [4592, 1030, 442, 0, 0, 0],             // translations
    [2425, 451, 208, 0, 0, 0],              // translations, a vector
    [1249, 181, 107, 0, 0, 0],              // translations, an iteration
    [1620, 212, 356, 0, 0, 0],              // colliders, a vector
    [575, 7896, 2, 0, 0, 0],                // a collider
    [886, 0, 0, 0, 0, 0],                   // a pin
    [5333, 330, 636, 8500, 9469, 0],        // pins or colliders that move
    [7411, 253, 490, 8876, 9458, 0],        // newmark
    [1353, 144, 150, 0, 0, 0],              // forces
    [7025, 552, 919, 8615, 9463, 0],        // start from velocity
    [6959, 555, 958, 8631, 9463, 0],        // start from velocity and force
    [-1059, -72, 11, 0, 0, 0],              // a past velocity
    [-2747, 26, -485, 0, 0, 0],             // rotations
    [160, -2, 1, 0, 0, 0],                  // held by pins
    [6338, 1859, 707, 0, 0, 0],             // coarse: an application more
    [-5937, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24233, 0, 0, 0, 0, 0],                 // coarse: its square
    [778, 0, 0, 0, 0, 0],                   // coarse: its cube
    [16596, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [31264, 0, 0, 0, 0, 0],                 // coarse: a product
    [7709, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13782, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [908, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [30740, 3908, 1604, 16936, 18274, 0],   // identity: step
    [38102, 4524, 2096, 34529, 38260, 0],   // identity: step with colliders
    [9070, 484, 895, 8719, 9459, 0],        // identity: iteration
    [30772, 3940, 1604, 16936, 18274, 0],   // mass: step
    [38135, 4556, 2096, 34529, 38260, 0],   // mass: step with colliders
    [9070, 484, 895, 8719, 9459, 0],        // mass: iteration
    [31806, 4957, 1713, 22568, 23156, 0],   // jacobi: step
    [36409, 5580, 2071, 34141, 38256, 0],   // jacobi: step with colliders
    [8945, 494, 895, 8693, 9461, 0],        // jacobi: iteration
    [31337, 6400, 1615, 26018, 28818, 0],   // block-jacobi: step
    [38126, 6893, 2093, 34528, 38256, 0],   // block-jacobi: step with colliders
    [9073, 484, 895, 8718, 9459, 0],        // block-jacobi: iteration
    [32958, 6096, 1560, 24050, 29264, 0],   // warped: step
    [40336, 6712, 2055, 41643, 49253, 0],   // warped: step with colliders
    [18628, 2629, 2122, 9622, 9453, 833],   // warped: iteration
    [32954, 6096, 1560, 24050, 29263, 0],   // warped-half: step
    [40345, 6712, 2056, 41643, 49254, 0],   // warped-half: step with colliders
    [17167, 4116, 3066, 14475, 9453, 1294], // warped-half: iteration
    [30511, 2615, 1543, 16966, 18278, 0],   // laplacian: step
    [37886, 3231, 2036, 34561, 38266, 0],   // laplacian: step with colliders
    [14213, 1660, 1244, 8222, 9454, 622],   // laplacian: iteration
    [30511, 2615, 1543, 16966, 18278, 0],   // laplacian-half: step
    [37888, 3231, 2036, 34561, 38266, 0],   // laplacian-half: step with colliders
    [13967, 1945, 1429, 9172, 9454, 711],   // laplacian-half: iteration
    [44268, 19857, 1485, 30622, 28719, 0],  // two-level: step
    [51166, 20338, 1961, 39164, 38155, 0],  // two-level: step with colliders
    [8235, 2462, 883, 8740, 9441, 0],       // two-level: iteration
];
