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
    [-291, 0, 9795, 0],         // any sweeps
    [74, 0, 9231, 0],           // a sweep
    [14737, 2622, 19399, 0],    // a stored vector
    [2101, 399, 0, 0],          // a pair of them
    [1057, 198, 0, 0],          // a vector and iteration
    [3207, 1748, 0, 0],         // translations
    [1534, 581, 0, 0],          // translations, a vector
    [860, 233, 0, 0],           // translations, an iteration
    [1934, 278, 0, 0],          // colliders, a vector
    [527, 10283, 0, 0],         // a collider
    [872, 0, 0, 0],             // a pin
    [6526, 691, 19321, 0],      // pins or colliders that move
    [6334, 839, 19332, 0],      // newmark
    [772, 339, 0, 0],           // forces
    [6802, 1192, 19338, 0],     // start from velocity
    [6756, 1201, 19354, 0],     // start from velocity and force
    [-1967, -92, 0, 0],         // a past velocity
    [-4655, -111, 0, 0],        // rotations
    [83, -2, 0, 0],             // held by pins
    [37091, 5813, 34380, 0],    // identity: step
    [46006, 6630, 73542, 0],    // identity: step with colliders
    [8873, 1099, 19340, 0],     // identity: iteration
    [37074, 5909, 34380, 0],    // mass: step
    [45989, 6726, 73542, 0],    // mass: step with colliders
    [8873, 1099, 19340, 0],     // mass: iteration
    [37335, 7238, 45438, 0],    // jacobi: step
    [45546, 7833, 73437, 0],    // jacobi: step with colliders
    [8889, 1098, 19342, 0],     // jacobi: iteration
    [37446, 8820, 54302, 0],    // block-jacobi: step
    [45966, 9513, 73534, 0],    // block-jacobi: step with colliders
    [8865, 1099, 19338, 0],     // block-jacobi: iteration
    [29677, 8363, 50473, 0],    // warped: step
    [38577, 9183, 89627, 0],    // warped: step with colliders
    [19450, 532, 7453, 2813],   // warped: iteration
    [29675, 8363, 50473, 0],    // warped-half: step
    [38580, 9183, 89626, 0],    // warped-half: step with colliders
    [19647, 544, 7440, 4415],   // warped-half: iteration
    [35831, 4429, 34320, 0],    // laplacian: step
    [44855, 5238, 73500, 0],    // laplacian: step with colliders
    [13161, 1531, 13605, 1385], // laplacian: iteration
    [35830, 4429, 34320, 0],    // laplacian-half: step
    [44857, 5238, 73500, 0],    // laplacian-half: step with colliders
    [13226, 1546, 13601, 1642], // laplacian-half: iteration
];

pub(super) const AARCH64: Table = [
    [-153, 0, 5641, 0],         // any sweeps
    [39, 0, 5325, 0],           // a sweep
    [13755, 2069, 15435, 0],    // a stored vector
    [1517, 317, 0, 0],          // a pair of them
    [744, 157, 0, 0],           // a vector and iteration
    [4546, 1048, 0, 0],         // translations
    [2357, 458, 0, 0],          // translations, a vector
    [1206, 185, 0, 0],          // translations, an iteration
    [1541, 224, 0, 0],          // colliders, a vector
    [388, 7901, 0, 0],          // a collider
    [981, 0, 0, 0],             // a pin
    [7877, 335, 15269, 0],      // pins or colliders that move
    [9672, 259, 15624, 0],      // newmark
    [1360, 149, 0, 0],          // forces
    [9214, 592, 15313, 0],      // start from velocity
    [9165, 597, 15327, 0],      // start from velocity and force
    [-1147, -70, 0, 0],         // a past velocity
    [-3045, 15, 0, 0],          // rotations
    [71, -2, 0, 0],             // held by pins
    [36533, 4219, 25947, 0],    // identity: step
    [45595, 4876, 58568, 0],    // identity: step with colliders
    [11029, 518, 15430, 0],     // identity: iteration
    [36516, 4251, 25947, 0],    // mass: step
    [45578, 4908, 58567, 0],    // mass: step with colliders
    [11029, 518, 15430, 0],     // mass: iteration
    [37327, 5279, 35596, 0],    // jacobi: step
    [43567, 5953, 58120, 0],    // jacobi: step with colliders
    [10941, 526, 15410, 0],     // jacobi: iteration
    [36988, 6707, 43424, 0],    // block-jacobi: step
    [45533, 7251, 58549, 0],    // block-jacobi: step with colliders
    [11011, 520, 15426, 0],     // block-jacobi: iteration
    [38233, 6407, 39981, 0],    // warped: step
    [47460, 7051, 72635, 0],    // warped: step with colliders
    [23243, -1715, 1715, 2896], // warped: iteration
    [38231, 6407, 39981, 0],    // warped-half: step
    [47465, 7051, 72635, 0],    // warped-half: step with colliders
    [23393, -1688, 1698, 4050], // warped-half: iteration
    [36133, 2920, 25989, 0],    // laplacian: step
    [45346, 3566, 58638, 0],    // laplacian: step with colliders
    [19900, -1749, 3600, 2234], // laplacian: iteration
    [36133, 2920, 25989, 0],    // laplacian-half: step
    [45347, 3566, 58638, 0],    // laplacian-half: step with colliders
    [19966, -1750, 3594, 2459], // laplacian-half: iteration
];
