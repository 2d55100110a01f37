//! Written by `examples/firmware/fit`: not to be edited.

use super::Table;

pub(super) const CORTEX_M4F: Table = [
    [-135, 0, 0, 8792, 3, 0],                // any sweeps
    [32, 0, 0, 25898, -1, 0],                // a sweep
    [23518, 6482, 974, 22669, 13472, 0],     // a stored vector
    [3616, 781, 522, 0, 0, 0],               // a pair of them
    [1385, 391, 259, 0, 0, 0],               // a vector and iteration
    [2049, 2489, -29, 0, 0, 0],              // translations
    [1351, 890, 10, 0, 0, 0],                // translations, a vector
    [1917, 395, 7, 0, 0, 0],                 // translations, an iteration
    [2173, 1117, -24, 0, 0, 0],              // colliders, a vector
    [2150, 2718, -523, 0, 0, 0],             // colliders, an iteration
    [296, -831, 14, 0, 0, 0],                // colliders, an iteration with a factor
    [-11736, 16814, -92, 0, 0, 0],           // a collider
    [14032, 0, 0, 0, 0, 0],                  // a pin
    [-3922, 1177, 257, 22413, 13531, 0],     // pins or colliders that move
    [10, 1129, -14, 22196, 13471, 0],        // newmark
    [-2681, 485, -12, 0, 0, 0],              // forces
    [11668, 4976, 5, 22557, 13467, 0],       // start from velocity
    [11444, 5024, 5, 22556, 13467, 0],       // start from velocity and force
    [14197, 4601, 251, 22558, 13468, 0],     // a search along the solution
    [-8077, -3241, 242, 0, 0, 0],            // a past velocity
    [-25581, -9722, 727, 0, 0, 0],           // rotations
    [-14049, 45, -6, 0, 0, 0],               // held by pins
    [26207, 1805, 1230, 0, 0, 0],            // coarse: an application more
    [2343, 0, 0, 0, 0, 0],                   // coarse: an aggregate
    [21590, 0, 0, 0, 0, 0],                  // coarse: its square
    [4582, 0, 0, 0, 0, 0],                   // coarse: its cube
    [33092, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [111635, 0, 0, 0, 0, 0],                 // coarse: a product
    [12266, 0, 0, 0, 0, 0],                  // coarse: a sum
    [11424, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [3355, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [17960, 3191, 485, 60944, 13125, 0],     // identity: step
    [37276, 13489, 884, 104032, 44970, 0],   // identity: step with colliders
    [10644, 1769, 784, 22264, 13471, 0],     // identity: iteration
    [18072, 3223, 485, 60944, 13125, 0],     // mass: step
    [37388, 13521, 884, 104032, 44970, 0],   // mass: step with colliders
    [10644, 1769, 784, 22264, 13471, 0],     // mass: iteration
    [19145, 4323, 489, 75942, 25018, 0],     // jacobi: step
    [27735, 14803, 818, 103648, 44964, 0],   // jacobi: step with colliders
    [11067, 1764, 784, 22293, 13472, 0],     // jacobi: iteration
    [18741, 5413, 485, 82123, 31494, 0],     // block-jacobi: step
    [37327, 15551, 883, 104043, 44972, 0],   // block-jacobi: step with colliders
    [10654, 1770, 784, 22259, 13471, 0],     // block-jacobi: iteration
    [17459, 7946, 342, 75547, 31479, 0],     // warped: step
    [35343, 17170, 888, 118705, 63319, 0],   // warped: step with colliders
    [13109, 5081, 19, 18342, 13472, 1614],   // warped: iteration
    [17444, 7947, 342, 75543, 31479, 0],     // warped-half: step
    [35392, 17166, 888, 118715, 63319, 0],   // warped-half: step with colliders
    [11787, 6256, 781, 22261, 13472, 1984],  // warped-half: iteration
    [15933, 2392, 315, 60895, 13127, 0],     // laplacian: step
    [33801, 11617, 861, 104050, 44967, 0],   // laplacian: step with colliders
    [13638, 3409, -214, 17143, 13472, 1289], // laplacian: iteration
    [15931, 2392, 315, 60895, 13127, 0],     // laplacian-half: step
    [33808, 11617, 861, 104051, 44967, 0],   // laplacian-half: step with colliders
    [13500, 3530, -135, 17549, 13472, 1327], // laplacian-half: iteration
    [38907, 21385, 386, 87988, 31446, 0],    // two-level: step
    [57980, 31501, 793, 109947, 44912, 0],   // two-level: step with colliders
    [13757, 3907, 790, 22313, 13470, 0],     // two-level: iteration
    [-8704, 2225, 67, 0, 0, 0],              // a sphere
    [-11101, 5610, 50, 0, 0, 0],             // a capsule
    [-11102, 13450, 50, 0, 0, 0],            // a box
    [-11102, 13770, 50, 0, 0, 0],            // a height field
    [10193, 19334, -117, 0, 0, 0],           // a frame
    [1530, 0, 0, 70409, 14288, 0],           // plastic flow
    [5337, 0, 0, 230023, 683, 0],            // fracture
    [544, 0, 0, 4352, 0, 0],                 // fracture: a place
    [9845, 5728, 891, 47249, 27180, 0],      // guarded
    [-12001, 894, 2022, 0, 0, 0],            // guarded: a vector
    [7553, -95, -1941, 0, 0, 0],             // guarded: translations
    [22186, 2814, -2025, 0, 0, 0],           // guarded: a collider
    [-1859, 1495, 1989, 0, 0, 0],            // guarded: a sphere
    [462, 2701, 2015, 0, 0, 0],              // guarded: a capsule
    [542, 5834, 2034, 0, 0, 0],              // guarded: a box
    [545, 5962, 2035, 0, 0, 0],              // guarded: a height field
    [-8973, 6532, 157, 0, 0, 0],             // guarded: a frame
    [-33286, -1762, -6557, 0, 0, 0],         // guarded: couplings
    [162105, 3050, -5546, 0, 0, 0],          // guarded: islands
    [45058, 2737, 1069, 21402, 13658, 0],    // couplings: step
    [-13022, 1234, 1142, 16878, 20064, 0],   // couplings: diagonal where none was
    [9633, -974, -966, 8591, 8715, 0],       // couplings: diagonal for jacobi
    [41863, 2906, -213, -3892, -36, 0],      // couplings: beside colliders
    [-104841, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [1422, 44, -99, 0, 0, 0],                // couplings: an iteration
    [3301, -18, 1575, 0, 0, 0],              // couplings: an iteration with a factor
    [2515, 515, -1749, 4846, -95, -350],     // couplings: an iteration with half a factor
    [134601, 0, 0, 0, 0, 0],                 // couplings: a slot
    [46090, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4971, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [20359, 868, -1571, 0, 0, 0],            // couplings: a switch
    [6431, 1426, 182, 0, 0, 0],              // couplings: a switch of a vector
    [1975, 645, 198, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [5960, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5077, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [46416, 0, 0, 0, 0, 0],                  // couplings: a link
    [3528, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [10083, 0, 0, 0, 0, 0],                  // couplings: a part
    [887, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [49921, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5334, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [165820, 568, 3289, 0, 0, 0],            // islands
    [43971, 1276, -2400, 0, 0, 0],           // islands, a vector
    [19295, 307, 519, 0, 0, 0],              // islands, an iteration
    [1939, 0, 0, 0, 0, 0],                   // islands: a part
    [2212, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const X86_64: Table = [
    [-180, 0, 0, 9481, -5, 0],               // any sweeps
    [86, 0, 0, 9436, 6, 0],                  // a sweep
    [25687, 4018, 1141, 9973, 11426, 0],     // a stored vector
    [2296, 385, 358, 0, 0, 0],               // a pair of them
    [814, 192, 174, 0, 0, 0],                // a vector and iteration
    [3849, 1839, 64, 0, 0, 0],               // translations
    [1746, 542, 40, 0, 0, 0],                // translations, a vector
    [1950, 229, 20, 0, 0, 0],                // translations, an iteration
    [1900, 731, 29, 0, 0, 0],                // colliders, a vector
    [4178, 2577, -37, 0, 0, 0],              // colliders, an iteration
    [-899, -791, -227, 0, 0, 0],             // colliders, an iteration with a factor
    [-11688, 17516, 0, 0, 0, 0],             // a collider
    [13467, 0, 0, 0, 0, 0],                  // a pin
    [-2946, 848, 307, 10102, 11562, 0],      // pins or colliders that move
    [1982, 1133, -59, 9928, 11441, 0],       // newmark
    [-1765, 360, -5, 0, 0, 0],               // forces
    [16345, 3629, 360, 10013, 11455, 0],     // start from velocity
    [15947, 3789, 360, 10013, 11454, 0],     // start from velocity and force
    [17507, 3074, 522, 9979, 11443, 0],      // a search along the solution
    [-12335, -2106, -107, 0, 0, 0],          // a past velocity
    [-39812, -5699, -466, 0, 0, 0],          // rotations
    [-13468, 35, -17, 0, 0, 0],              // held by pins
    [25329, 1955, 1025, 0, 0, 0],            // coarse: an application more
    [-19085, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [34836, 0, 0, 0, 0, 0],                  // coarse: its square
    [863, 0, 0, 0, 0, 0],                    // coarse: its cube
    [29144, 0, 0, 0, 0, 0],                  // coarse: a cut block
    [42627, 0, 0, 0, 0, 0],                  // coarse: a product
    [10549, 0, 0, 0, 0, 0],                  // coarse: a sum
    [15611, 0, 0, 0, 0, 0],                  // coarse: an aggregate, an application
    [1167, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [26769, 2925, -96, 22934, 20817, 0],     // identity: step
    [51996, 11397, 761, 42616, 43514, 0],    // identity: step with colliders
    [10194, 1097, 637, 9986, 11421, 0],      // identity: iteration
    [26769, 2989, -96, 22934, 20817, 0],     // mass: step
    [51996, 11461, 761, 42616, 43514, 0],    // mass: step with colliders
    [10194, 1097, 637, 9986, 11421, 0],      // mass: iteration
    [27903, 3905, -104, 29064, 27177, 0],    // jacobi: step
    [45049, 12404, 774, 42773, 43466, 0],    // jacobi: step with colliders
    [10447, 1104, 639, 9984, 11424, 0],      // jacobi: iteration
    [27435, 5409, -99, 32370, 32132, 0],     // block-jacobi: step
    [51975, 13751, 760, 42615, 43514, 0],    // block-jacobi: step with colliders
    [10232, 1096, 637, 9988, 11421, 0],      // block-jacobi: iteration
    [28516, 3530, 5229, 31427, 32500, 0],    // warped: step
    [48941, 11097, 5896, 50792, 55207, 0],   // warped: step with colliders
    [16906, 4854, 1282, 9729, 11416, 1138],  // warped: iteration
    [28515, 3530, 5229, 31427, 32500, 0],    // warped-half: step
    [48943, 11096, 5897, 50793, 55208, 0],   // warped-half: step with colliders
    [15647, 5961, 2021, 13524, 11417, 1494], // warped-half: iteration
    [24472, 2538, -321, 22886, 20817, 0],    // laplacian: step
    [44895, 10105, 345, 42250, 43521, 0],    // laplacian: step with colliders
    [13311, 3193, 404, 8073, 11418, 839],    // laplacian: iteration
    [24472, 2538, -321, 22886, 20817, 0],    // laplacian-half: step
    [44893, 10105, 345, 42250, 43521, 0],    // laplacian-half: step with colliders
    [13127, 3329, 514, 8633, 11418, 887],    // laplacian-half: iteration
    [46722, 22936, -204, 38682, 32063, 0],   // two-level: step
    [71809, 31230, 680, 49023, 43469, 0],    // two-level: step with colliders
    [9783, 3314, 636, 10038, 11407, 0],      // two-level: iteration
    [-7772, 2183, -45, 0, 0, 0],             // a sphere
    [-6739, 4344, -522, 0, 0, 0],            // a capsule
    [-6689, 11064, -517, 0, 0, 0],           // a box
    [-6687, 11384, -516, 0, 0, 0],           // a height field
    [11770, 33537, 244, 0, 0, 0],            // a frame
    [1973, 0, 0, 23899, 11967, 0],           // plastic flow
    [4732, 0, 0, 43017, 5729, 0],            // fracture
    [513, 0, 0, 4606, 1, 0],                 // fracture: a place
    [13362, 5415, 774, 22128, 23442, 0],     // guarded
    [-13261, 648, 2240, 0, 0, 0],            // guarded: a vector
    [9276, -354, -2008, 0, 0, 0],            // guarded: translations
    [26845, 2659, -2295, 0, 0, 0],           // guarded: a collider
    [-5254, 1719, 2256, 0, 0, 0],            // guarded: a sphere
    [-6272, 2245, 2737, 0, 0, 0],            // guarded: a capsule
    [-6171, 4930, 2745, 0, 0, 0],            // guarded: a box
    [-6166, 5058, 2745, 0, 0, 0],            // guarded: a height field
    [-10454, 12146, -194, 0, 0, 0],          // guarded: a frame
    [-10907, -1131, -8452, 0, 0, 0],         // guarded: couplings
    [88944, 1857, -5750, 0, 0, 0],           // guarded: islands
    [-70445, 4671, 7970, 2691, 10675, 0],    // couplings: step
    [-8983, 290, -1069, 9094, 9579, 0],      // couplings: diagonal where none was
    [19162, -2111, -2732, 9751, 6505, 0],    // couplings: diagonal for jacobi
    [27293, 1740, -2239, -231, -118, 0],     // couplings: beside colliders
    [-104100, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [726, 36, 320, 0, 0, 0],                 // couplings: an iteration
    [-795, 2, -52, 0, 0, 0],                 // couplings: an iteration with a factor
    [918, 165, -1785, 3206, -1072, -243],    // couplings: an iteration with half a factor
    [122889, 0, 0, 0, 0, 0],                 // couplings: a slot
    [54807, 0, 0, 0, 0, 0],                  // couplings: a slot beside rigid bodies
    [4772, 0, 0, 0, 0, 0],                   // couplings: a slot, an application
    [2841, 933, -4740, 0, 0, 0],             // couplings: a switch
    [3601, 497, 415, 0, 0, 0],               // couplings: a switch of a vector
    [1340, 285, 354, 0, 0, 0],               // couplings: a switch of a pair of vectors
    [6308, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch
    [5238, 0, 0, 0, 0, 0],                   // couplings: a slot, a switch of a vector
    [38349, 0, 0, 0, 0, 0],                  // couplings: a link
    [3054, 0, 0, 0, 0, 0],                   // couplings: a link beside rigid bodies
    [20863, 0, 0, 0, 0, 0],                  // couplings: a part
    [606, 0, 0, 0, 0, 0],                    // couplings: a part and slot
    [44261, 0, 0, 0, 0, 0],                  // couplings: a rigid body
    [5860, 0, 0, 0, 0, 0],                   // couplings: a rigid body, a projection
    [47815, 584, 4226, 0, 0, 0],             // islands
    [15523, 634, -1961, 0, 0, 0],            // islands, a vector
    [6982, 88, 1527, 0, 0, 0],               // islands, an iteration
    [-1200, 0, 0, 0, 0, 0],                  // islands: a part
    [2269, 0, 0, 0, 0, 0],                   // islands: a part, an operation
];

pub(super) const AARCH64: Table = [
    [-54, 0, 0, 7110, 14, 0],               // any sweeps
    [63, 0, 0, 6612, 2, 0],                 // a sweep
    [23860, 3018, 1666, 8193, 9696, 0],     // a stored vector
    [1930, 297, 479, 0, 0, 0],              // a pair of them
    [778, 148, 237, 0, 0, 0],               // a vector and iteration
    [5606, 1106, 449, 0, 0, 0],             // translations
    [2521, 430, 207, 0, 0, 0],              // translations, a vector
    [1941, 179, 107, 0, 0, 0],              // translations, an iteration
    [3100, 485, 319, 0, 0, 0],              // colliders, a vector
    [6989, 1677, 590, 0, 0, 0],             // colliders, an iteration
    [-1844, -396, -380, 0, 0, 0],           // colliders, an iteration with a factor
    [-5941, 13938, 145, 0, 0, 0],           // a collider
    [8512, 0, 0, 0, 0, 0],                  // a pin
    [39, 510, 655, 7764, 9784, 0],          // pins or colliders that move
    [2988, 839, 169, 7903, 9705, 0],        // newmark
    [-123, 155, 144, 0, 0, 0],              // forces
    [17351, 2593, 898, 7992, 9715, 0],      // start from velocity
    [17127, 2641, 898, 7992, 9715, 0],      // start from velocity and force
    [18542, 2055, 1124, 8002, 9710, 0],     // a search along the solution
    [-11804, -1569, -258, 0, 0, 0],         // a past velocity
    [-36608, -4626, -785, 0, 0, 0],         // rotations
    [-7963, 17, 2, 0, 0, 0],                // held by pins
    [15190, 1780, 874, 0, 0, 0],            // coarse: an application more
    [-5767, 0, 0, 0, 0, 0],                 // coarse: an aggregate
    [24825, 0, 0, 0, 0, 0],                 // coarse: its square
    [777, 0, 0, 0, 0, 0],                   // coarse: its cube
    [22435, 0, 0, 0, 0, 0],                 // coarse: a cut block
    [32721, 0, 0, 0, 0, 0],                 // coarse: a product
    [7474, 0, 0, 0, 0, 0],                  // coarse: a sum
    [13395, 0, 0, 0, 0, 0],                 // coarse: an aggregate, an application
    [907, 0, 0, 0, 0, 0],                   // coarse: its square, an application
    [22828, 2202, 1181, 16372, 18053, 0],   // identity: step
    [51390, 8764, 2610, 33560, 37404, 0],   // identity: step with colliders
    [11404, 529, 1103, 8252, 9697, 0],      // identity: iteration
    [22844, 2250, 1181, 16372, 18053, 0],   // mass: step
    [51407, 8812, 2610, 33560, 37404, 0],   // mass: step with colliders
    [11405, 529, 1103, 8252, 9697, 0],      // mass: iteration
    [24985, 2826, 1279, 21508, 22950, 0],   // jacobi: step
    [54160, 8930, 2889, 34897, 37369, 0],   // jacobi: step with colliders
    [11283, 555, 1101, 8194, 9698, 0],      // jacobi: iteration
    [23440, 3832, 1181, 23778, 27754, 0],   // block-jacobi: step
    [51232, 10263, 2608, 33532, 37403, 0],  // block-jacobi: step with colliders
    [11502, 522, 1104, 8269, 9696, 0],      // block-jacobi: iteration
    [31033, 2389, 2187, 22327, 27960, 0],   // warped: step
    [51227, 8760, 3067, 38635, 47324, 0],   // warped: step with colliders
    [20494, 2895, 2297, 9057, 9691, 831],   // warped: iteration
    [31095, 2384, 2188, 22340, 27960, 0],   // warped-half: step
    [50899, 8785, 3064, 38568, 47325, 0],   // warped-half: step with colliders
    [19195, 4150, 3083, 13103, 9692, 1216], // warped-half: iteration
    [21967, 1702, 1009, 16446, 18054, 0],   // laplacian: step
    [42346, 8059, 1889, 32792, 37414, 0],   // laplacian: step with colliders
    [16452, 1938, 1433, 7654, 9693, 635],   // laplacian: iteration
    [21982, 1701, 1008, 16449, 18054, 0],   // laplacian-half: step
    [42257, 8065, 1889, 32775, 37414, 0],   // laplacian-half: step with colliders
    [16250, 2167, 1561, 8315, 9693, 702],   // laplacian-half: iteration
    [32794, 17344, 1100, 29425, 27681, 0],  // two-level: step
    [61603, 23687, 2561, 39394, 37354, 0],  // two-level: step with colliders
    [11011, 2472, 1107, 8353, 9682, 0],     // two-level: iteration
    [-5677, 2238, -193, 0, 0, 0],           // a sphere
    [-4610, 4548, -538, 0, 0, 0],           // a capsule
    [-4579, 9828, -539, 0, 0, 0],           // a box
    [-4576, 10308, -539, 0, 0, 0],          // a height field
    [9015, 25119, 419, 0, 0, 0],            // a frame
    [3263, 0, 0, 18464, 10202, 0],          // plastic flow
    [4619, 0, 0, 29273, 4610, 0],           // fracture
    [451, 0, 0, 3582, 1, 0],                // fracture: a place
    [19772, 3905, 1421, 18078, 19828, 0],   // guarded
    [-8268, 415, 1600, 0, 0, 0],            // guarded: a vector
    [5532, 30, -1359, 0, 0, 0],             // guarded: translations
    [16631, 1978, -1589, 0, 0, 0],          // guarded: a collider
    [-3475, 1458, 1585, 0, 0, 0],           // guarded: a sphere
    [-4572, 2059, 1932, 0, 0, 0],           // guarded: a capsule
    [-4485, 4169, 1939, 0, 0, 0],           // guarded: a box
    [-4478, 4360, 1940, 0, 0, 0],           // guarded: a height field
    [-8026, 9368, -397, 0, 0, 0],           // guarded: a frame
    [-33252, -521, -6931, 0, 0, 0],         // guarded: couplings
    [87532, 1436, -5305, 0, 0, 0],          // guarded: islands
    [-3650, 1500, 913, 9580, 9791, 0],      // couplings: step
    [-67, 206, -1544, 7391, 9602, 0],       // couplings: diagonal where none was
    [17891, -1557, -2507, 7122, 7927, 0],   // couplings: diagonal for jacobi
    [35772, 2249, -5300, -1791, -3030, 0],  // couplings: beside colliders
    [-89134, 0, 0, 0, 0, 0],                // couplings: a rigid body and collider
    [-385, 89, -188, 0, 0, 0],              // couplings: an iteration
    [279, 38, -725, 0, 0, 0],               // couplings: an iteration with a factor
    [2590, -404, -838, 1047, -366, -23],    // couplings: an iteration with half a factor
    [110126, 0, 0, 0, 0, 0],                // couplings: a slot
    [44958, 0, 0, 0, 0, 0],                 // couplings: a slot beside rigid bodies
    [4525, 0, 0, 0, 0, 0],                  // couplings: a slot, an application
    [5048, 831, -3973, 0, 0, 0],            // couplings: a switch
    [3244, 397, 452, 0, 0, 0],              // couplings: a switch of a vector
    [1150, 228, 346, 0, 0, 0],              // couplings: a switch of a pair of vectors
    [5477, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch
    [4932, 0, 0, 0, 0, 0],                  // couplings: a slot, a switch of a vector
    [35230, 0, 0, 0, 0, 0],                 // couplings: a link
    [2088, 0, 0, 0, 0, 0],                  // couplings: a link beside rigid bodies
    [26504, 0, 0, 0, 0, 0],                 // couplings: a part
    [712, 0, 0, 0, 0, 0],                   // couplings: a part and slot
    [33374, 0, 0, 0, 0, 0],                 // couplings: a rigid body
    [4975, 0, 0, 0, 0, 0],                  // couplings: a rigid body, a projection
    [38967, 809, 4238, 0, 0, 0],            // islands
    [13878, 545, -2089, 0, 0, 0],           // islands, a vector
    [5134, 62, 1253, 0, 0, 0],              // islands, an iteration
    [-1812, 0, 0, 0, 0, 0],                 // islands: a part
    [2487, 0, 0, 0, 0, 0],                  // islands: a part, an operation
];
