//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-366, 0, 10553, 0],       // any sweeps
    [90, 0, 32786, 0],         // a sweep
    [10469, 4252, 26351, 0],   // a stored vector
    [1935, 1121, 0, 0],        // a pair of them
    [963, 558, 0, 0],          // a vector and iteration
    [2104, 2299, 0, 0],        // translations
    [917, 940, 0, 0],          // translations, a vector
    [512, 402, 0, 0],          // translations, an iteration
    [1511, 942, 0, 0],         // colliders, a vector
    [536, 9898, 0, 0],         // a collider
    [1013, 0, 0, 0],           // a pin
    [2598, 1246, 26231, 0],    // pins or colliders that move
    [1701, 982, 26212, 0],     // newmark
    [442, 450, 0, 0],          // forces
    [2505, 1772, 26274, 0],    // start from velocity
    [2185, 1804, 26274, 0],    // start from velocity and force
    [-2229, -108, 0, 0],       // a past velocity
    [-7088, -47, 0, 0],        // rotations
    [162, -3, 0, 0],           // held by pins
    [19078, 6489, 63858, 0],   // identity: step
    [24679, 8258, 120163, 0],  // identity: step with colliders
    [4941, 2146, 26263, 0],    // identity: iteration
    [19110, 6617, 63857, 0],   // mass: step
    [24711, 8386, 120163, 0],  // mass: step with colliders
    [4941, 2146, 26263, 0],    // mass: iteration
    [19433, 8179, 80742, 0],   // jacobi: step
    [24795, 9689, 120170, 0],  // jacobi: step with colliders
    [4964, 2145, 26265, 0],    // jacobi: iteration
    [19312, 9705, 93906, 0],   // block-jacobi: step
    [24652, 11314, 120160, 0], // block-jacobi: step with colliders
    [4939, 2146, 26262, 0],    // block-jacobi: iteration
    [19827, 9182, 87722, 0],   // warped: step
    [25464, 10948, 144031, 0], // warped: step with colliders
    [6052, 5372, 25032, 1263], // warped: iteration
    [19823, 9182, 87722, 0],   // warped-half: step
    [25474, 10948, 144031, 0], // warped-half: step with colliders
    [6165, 5659, 25028, 3439], // warped-half: iteration
    [18674, 5257, 63858, 0],   // laplacian: step
    [24308, 7024, 120166, 0],  // laplacian: step with colliders
    [6172, 4228, 25057, 763],  // laplacian: iteration
    [18674, 5257, 63858, 0],   // laplacian-half: step
    [24310, 7024, 120166, 0],  // laplacian-half: step with colliders
    [6172, 4243, 25056, 1051], // laplacian-half: iteration
];

pub(super) const X86_64: Table = [
    [-322, 0, 3967, 0],        // any sweeps
    [83, 0, 9360, 0],          // a sweep
    [15764, 2354, 19480, 0],   // a stored vector
    [2113, 294, 0, 0],         // a pair of them
    [1071, 145, 0, 0],         // a vector and iteration
    [3936, 1723, 0, 0],        // translations
    [2021, 652, 0, 0],         // translations, a vector
    [1131, 268, 0, 0],         // translations, an iteration
    [1969, 226, 0, 0],         // colliders, a vector
    [518, 10267, 0, 0],        // a collider
    [1592, 0, 0, 0],           // a pin
    [7478, 676, 19415, 0],     // pins or colliders that move
    [7267, 797, 19461, 0],     // newmark
    [1648, 338, 0, 0],         // forces
    [7478, 1178, 19432, 0],    // start from velocity
    [7676, 1193, 19442, 0],    // start from velocity and force
    [-1524, -94, 0, 0],        // a past velocity
    [-4967, -121, 0, 0],       // rotations
    [-700, -3, 0, 0],          // held by pins
    [37831, 6154, 46411, 0],   // identity: step
    [47142, 6872, 88803, 0],   // identity: step with colliders
    [9687, 952, 19449, 0],     // identity: iteration
    [37812, 6250, 46411, 0],   // mass: step
    [47124, 6968, 88803, 0],   // mass: step with colliders
    [9686, 953, 19449, 0],     // mass: iteration
    [38407, 7582, 57601, 0],   // jacobi: step
    [46550, 8098, 88636, 0],   // jacobi: step with colliders
    [9683, 953, 19449, 0],     // jacobi: iteration
    [38704, 9142, 69524, 0],   // block-jacobi: step
    [47075, 9741, 88790, 0],   // block-jacobi: step with colliders
    [9675, 953, 19447, 0],     // block-jacobi: iteration
    [38033, 8662, 66921, 0],   // warped: step
    [47497, 9369, 109341, 0],  // warped: step with colliders
    [19519, 879, 8891, 2603],  // warped: iteration
    [38030, 8662, 66921, 0],   // warped-half: step
    [47504, 9369, 109341, 0],  // warped-half: step with colliders
    [19716, 907, 8877, 4237],  // warped-half: iteration
    [36537, 4784, 46354, 0],   // laplacian: step
    [45989, 5492, 88771, 0],   // laplacian: step with colliders
    [15210, 719, 11438, 1708], // laplacian: iteration
    [36536, 4784, 46354, 0],   // laplacian-half: step
    [45991, 5492, 88771, 0],   // laplacian-half: step with colliders
    [15309, 699, 11392, 1971], // laplacian-half: iteration
];

pub(super) const AARCH64: Table = [
    [-157, 0, 2600, 0],         // any sweeps
    [45, 0, 5390, 0],           // a sweep
    [14787, 1857, 15646, 0],    // a stored vector
    [1604, 243, 0, 0],          // a pair of them
    [802, 120, 0, 0],           // a vector and iteration
    [4803, 1045, 0, 0],         // translations
    [2382, 459, 0, 0],          // translations, a vector
    [1265, 185, 0, 0],          // translations, an iteration
    [1580, 188, 0, 0],          // colliders, a vector
    [422, 7949, 0, 0],          // a collider
    [1411, 0, 0, 0],            // a pin
    [7900, 345, 15385, 0],      // pins or colliders that move
    [9405, 322, 15730, 0],      // newmark
    [2026, 147, 0, 0],          // forces
    [9302, 582, 15483, 0],      // start from velocity
    [9514, 582, 15498, 0],      // start from velocity and force
    [-1129, -72, 0, 0],         // a past velocity
    [-3768, 10, 0, 0],          // rotations
    [-452, -2, 0, 0],           // held by pins
    [36274, 4226, 35435, 0],    // identity: step
    [45948, 4796, 69637, 0],    // identity: step with colliders
    [11331, 521, 15574, 0],     // identity: iteration
    [36272, 4258, 35435, 0],    // mass: step
    [45947, 4828, 69637, 0],    // mass: step with colliders
    [11331, 521, 15574, 0],     // mass: iteration
    [37402, 5283, 44880, 0],    // jacobi: step
    [43989, 5872, 69193, 0],    // jacobi: step with colliders
    [11264, 527, 15559, 0],     // jacobi: iteration
    [37434, 6714, 54349, 0],    // block-jacobi: step
    [45864, 7172, 69617, 0],    // block-jacobi: step with colliders
    [11314, 523, 15570, 0],     // block-jacobi: iteration
    [37197, 6223, 53138, 0],    // warped: step
    [47054, 6779, 87377, 0],    // warped: step with colliders
    [23854, -1784, 1440, 2923], // warped: iteration
    [37195, 6223, 53138, 0],    // warped-half: step
    [47058, 6779, 87376, 0],    // warped-half: step with colliders
    [24037, -1758, 1423, 4093], // warped-half: iteration
    [36014, 2927, 35476, 0],    // laplacian: step
    [45853, 3485, 69710, 0],    // laplacian: step with colliders
    [20571, -1902, 3356, 2288], // laplacian: iteration
    [36013, 2927, 35476, 0],    // laplacian-half: step
    [45854, 3485, 69710, 0],    // laplacian-half: step with colliders
    [20621, -1887, 3351, 2512], // laplacian-half: iteration
];
