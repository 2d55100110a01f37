/* The interface from C, on a host or as firmware: the scene "contact" of examples/cases with every preconditioner, whose
 * hashes after 1, 20 and 1,000 steps it prints in the form of golden.txt, and every bad call, which must return its
 * code. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "../femto.h"
/* The body as assets, with the factors of examples/cases: printed by its program `assets`. */
#include "assets.h"

enum { NODES = 16, TETS = 18, BYTES = 8192, AGGREGATES = 8 };

static _Alignas(FEMTO_ALIGNMENT) unsigned char rest[BYTES], state[BYTES], work[BYTES], other[BYTES];
static float nodes[NODES][3], velocities[NODES][3];
static uint32_t tets[TETS][4];
static uint8_t aggregates[NODES];

static const FemtoMaterial MATERIAL = {2e4f, 0.4f, 1000.0f, 0.05f, 1e-4f};
static const FemtoStart START = {FEMTO_START_GALERKIN, 1};
static const FemtoSettings SETTINGS = {
    .dt = 1.0f / 150.0f,
    .theta = 1.0f,
    .iterations = 5,
    .polar_sweeps = 2,
    .start = {FEMTO_START_GALERKIN, 1},
    .preconditioner = FEMTO_PRECONDITIONER_JACOBI,
};
static const FemtoSettings TWO_LEVEL = {
    .dt = 1.0f / 150.0f,
    .theta = 1.0f,
    .iterations = 5,
    .polar_sweeps = 2,
    .start = {FEMTO_START_GALERKIN, 1},
    .preconditioner = FEMTO_PRECONDITIONER_TWO_LEVEL,
    .aggregate_count = AGGREGATES,
    .aggregates = aggregates,
};

static int failures;

static void expect_at(int line, const char *call, FemtoStatus got, FemtoStatus expected) {
    if (got == expected) return;
    failures++;
    printf("line %d: %s returned %d, not %d\n", line, call, (int)got, (int)expected);
}
#define EXPECT(expected, call) expect_at(__LINE__, #call, call, FEMTO_STATUS_##expected)

/* The box of 3 x 1 x 1 cells, as examples/cases/src/mesh.rs has it. */
static void make_mesh(void) {
    static const int WALKS[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
    static const int STEPS[3] = {4, 2, 1}, CELLS[3] = {3, 1, 1};
    uint32_t seed = 1, count = 0;
    for (int node = 0; node < NODES; node++) {
        const int at[3] = {node / 4, node / 2 % 2, node % 2};
        for (int axis = 0; axis < 3; axis++) {
            seed = seed * 1664525u + 1013904223u;
            nodes[node][axis] = 0.125f * ((float)at[axis] + 0.125f * ((float)(seed >> 8) / 8388608.0f - 1.0f));
        }
        const float *x = nodes[node], v[3] = {1.0f - 4.0f * x[1] + 3.0f * x[2], 0.5f + 4.0f * x[0], -0.25f - 3.0f * x[0]};
        memcpy(velocities[node], v, sizeof v);
        if (at[0] == CELLS[0] || at[1] == CELLS[1] || at[2] == CELLS[2]) continue;
        for (int walk = 0; walk < 6; walk++, count++) {
            uint32_t tet[4] = {(uint32_t)node};
            for (int k = 0; k < 3; k++) tet[k + 1] = tet[k] + (uint32_t)STEPS[WALKS[walk][k]];
            const bool odd = walk >= 3;
            memcpy(tets[count], (uint32_t[4]){tet[0], tet[1], tet[odd ? 3 : 2], tet[odd ? 2 : 3]}, sizeof tet);
        }
    }
}

static FemtoStatus init(void) {
    FemtoStatus status = femto_rest_init(rest, BYTES, nodes, NODES, tets, TETS, &MATERIAL);
    if (status == FEMTO_STATUS_OK) status = femto_state_init(state, BYTES, rest, BYTES, START);
    if (status == FEMTO_STATUS_OK) status = femto_place(state, BYTES, rest, BYTES, nodes, velocities, NODES);
    return status;
}

static uint64_t hash(void) {
    uint64_t value = 0;
    EXPECT(OK, femto_hash(state, BYTES, &value));
    return value;
}

/* A snapshot is a copy of the state's bytes: three steps from it are three steps. */
static void replay(const void *body, size_t bytes, const FemtoSettings *settings, const FemtoScene *scene) {
    uint64_t first = 0;
    memcpy(other, state, BYTES);
    for (int turn = 0; turn < 2; turn++) {
        for (int k = 0; k < 3; k++)
            EXPECT(OK, femto_step(state, BYTES, body, bytes, work, BYTES, settings, scene, NULL));
        if (turn == 1 && hash() != first) {
            failures++;
            puts("a replay has other bits");
        }
        first = hash();
        memcpy(state, other, BYTES);
    }
}

/* A run of the body that is in `rest` data or in an asset. */
static void run(const char *kind, const char *name, const void *body, size_t bytes, const FemtoSettings *settings) {
    FemtoCollider colliders[2] = {
        {FEMTO_COLLIDER_HALF_SPACE, {0.1f, 1.0f, 0.05f}, 0.0f, 0.4f, {0}},
        {FEMTO_COLLIDER_SPHERE, {0.5f, -0.5f, 0.1f}, 0.45f, 0.2f, {0.01f, 0.0f, 0.02f}},
    };
    const FemtoScene scene = {{0.0f, -9.81f, 0.0f}, NULL, 0, NULL, 0, colliders, 2};
    EXPECT(OK, femto_state_init(state, BYTES, body, bytes, START));
    EXPECT(OK, femto_place(state, BYTES, body, bytes, nodes, velocities, NODES));
    for (int step = 1; step <= 1000; step++) {
        FemtoReport report;
        EXPECT(OK, femto_step(state, BYTES, body, bytes, work, BYTES, settings, &scene, &report));
        if (step == 10) replay(body, bytes, settings, &scene);
        for (int axis = 0; axis < 3; axis++) colliders[1].vector[axis] += colliders[1].velocity[axis] * settings->dt;
        if (step == 1 || step == 20 || step == 1000)
            printf("%s %s %d %08lx%08lx\n", kind, name, step, (unsigned long)(hash() >> 32),
                   (unsigned long)(hash() & 0xffffffffu));
    }
}

/* Every preconditioner; the factored ones with the body read from the asset, too. */
static void runs(void) {
    static const char *const LOCAL[] = {"identity", "mass", "jacobi", "block-jacobi"};
    static const struct {
        const char *name;
        const void *bytes;
        size_t count;
    } FACTORED[] = {{"warped", ASSET_WARPED, sizeof ASSET_WARPED},
                    {"warped-half", ASSET_WARPED_HALF, sizeof ASSET_WARPED_HALF},
                    {"laplacian", ASSET_LAPLACIAN, sizeof ASSET_LAPLACIAN},
                    {"laplacian-half", ASSET_LAPLACIAN_HALF, sizeof ASSET_LAPLACIAN_HALF}};
    EXPECT(OK, femto_rest_init(rest, BYTES, nodes, NODES, tets, TETS, &MATERIAL));
    run("scene", "contact", rest, BYTES, &SETTINGS);
    for (uint32_t k = 0; k < 4; k++) {
        FemtoSettings settings = SETTINGS;
        settings.preconditioner = FEMTO_PRECONDITIONER_IDENTITY + k;
        run("preconditioner", LOCAL[k], rest, BYTES, &settings);
    }
    for (size_t k = 0; k < sizeof FACTORED / sizeof *FACTORED; k++) {
        FemtoAsset asset;
        EXPECT(OK, femto_asset_open(FACTORED[k].bytes, FACTORED[k].count, &asset));
        if (asset.nodes != NODES || asset.tets != TETS || asset.pin_count || asset.settings.factor != FACTORED[k].bytes) {
            failures++;
            puts("an asset says other than what is in it");
        }
        run("preconditioner", FACTORED[k].name, FACTORED[k].bytes, FACTORED[k].count, &asset.settings);
    }
    EXPECT(OK, femto_aggregates_init(aggregates, NODES, rest, BYTES, AGGREGATES));
    run("preconditioner", "two-level", rest, BYTES, &TWO_LEVEL);
}

static FemtoStatus step_with(const FemtoSettings *settings, const FemtoScene *scene) {
    return femto_step(state, BYTES, rest, BYTES, work, BYTES, settings, scene, NULL);
}

/* Each argument of each call, wrong in each way; the state is as it was after all of them. */
static void bad_calls(void) {
    const FemtoScene scene = {{0.0f, -9.81f, 0.0f}, NULL, 0, NULL, 0, NULL, 0};
    const size_t rest_bytes = femto_rest_bytes(NODES, TETS), state_bytes = femto_state_bytes(NODES, TETS, START),
                 work_bytes = femto_workspace_bytes(NODES, TETS, START);
    uint64_t value;
    size_t count;

    /* Sizes. */
    if (!rest_bytes || !state_bytes || !work_bytes || rest_bytes > BYTES || state_bytes > BYTES || work_bytes > BYTES) {
        failures++;
        printf("sizes %zu %zu %zu\n", rest_bytes, state_bytes, work_bytes);
    }
    if (femto_rest_bytes(0, 1) || femto_rest_bytes(SIZE_MAX, SIZE_MAX) || femto_state_bytes(1, 0, START) ||
        femto_workspace_bytes(SIZE_MAX / 2, 1, START) || femto_state_bytes(1, 1, (FemtoStart){9, 0}) ||
        femto_workspace_bytes(1, 1, (FemtoStart){FEMTO_START_GALERKIN, 256})) {
        failures++;
        puts("a size of nothing");
    }

    /* Before init, and with wrong bytes. */
    memset(other, 0, BYTES);
    EXPECT(WRONG_BYTES, femto_state_init(state, BYTES, other, BYTES, START));
    EXPECT(OK, init());
    EXPECT(WRONG_BYTES, femto_step(other, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(WRONG_BYTES, femto_step(state, BYTES, other, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(WRONG_BYTES, femto_place(other, BYTES, rest, BYTES, nodes, velocities, NODES));
    EXPECT(WRONG_BYTES, femto_read(other, BYTES, NULL, NULL, &count));
    EXPECT(WRONG_BYTES, femto_hash(other, BYTES, &value));
    memset(other, 0xff, BYTES);
    EXPECT(WRONG_BYTES, femto_step(other, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(WRONG_BYTES, femto_step(state, BYTES, other, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    /* Rest data in the place of a state, and counts that lie. */
    memcpy(other, rest, BYTES);
    EXPECT(WRONG_BYTES, femto_step(other, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    memset(other + 4, 0xff, 8);
    EXPECT(TOO_SMALL, femto_state_init(work, BYTES, other, BYTES, START));
    memcpy(other, state, BYTES);
    memset(other + 12, 0xff, 4);
    EXPECT(TOO_SMALL, femto_hash(other, BYTES, &value));
    memcpy(other, rest, BYTES);
    memset(other + 128, 0xff, rest_bytes - 128);
    EXPECT(REFUSED, femto_step(state, BYTES, other, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    /* A state of another body. */
    const float moved = nodes[0][0];
    nodes[0][0] += 0.01f;
    EXPECT(OK, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, &MATERIAL));
    EXPECT(WRONG_BYTES, femto_step(state, BYTES, other, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    nodes[0][0] = moved;

    EXPECT(OK, init());
    const uint64_t before = hash();

    /* Null, misaligned, too small, overlapping pieces. */
    EXPECT(NULL, femto_rest_init(NULL, BYTES, nodes, NODES, tets, TETS, &MATERIAL));
    EXPECT(NULL, femto_rest_init(other, BYTES, NULL, NODES, tets, TETS, &MATERIAL));
    EXPECT(NULL, femto_rest_init(other, BYTES, nodes, NODES, NULL, TETS, &MATERIAL));
    EXPECT(NULL, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, NULL));
    EXPECT(NULL, femto_state_init(NULL, BYTES, rest, BYTES, START));
    EXPECT(NULL, femto_state_init(other, BYTES, NULL, BYTES, START));
    EXPECT(NULL, femto_place(NULL, BYTES, rest, BYTES, nodes, velocities, NODES));
    EXPECT(NULL, femto_place(state, BYTES, NULL, BYTES, nodes, velocities, NODES));
    EXPECT(NULL, femto_place(state, BYTES, rest, BYTES, NULL, velocities, NODES));
    EXPECT(NULL, femto_place(state, BYTES, rest, BYTES, nodes, NULL, NODES));
    EXPECT(NULL, femto_step(NULL, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(NULL, femto_step(state, BYTES, NULL, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(NULL, femto_step(state, BYTES, rest, BYTES, NULL, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(NULL, step_with(NULL, &scene));
    EXPECT(NULL, step_with(&SETTINGS, NULL));
    EXPECT(NULL, femto_read(NULL, BYTES, NULL, NULL, &count));
    EXPECT(NULL, femto_hash(NULL, BYTES, &value));
    EXPECT(NULL, femto_hash(state, BYTES, NULL));
    EXPECT(MISALIGNED, femto_rest_init(other + 4, BYTES - 4, nodes, NODES, tets, TETS, &MATERIAL));
    EXPECT(MISALIGNED, femto_rest_init(other, BYTES, (const void *)(work + 1), NODES, tets, TETS, &MATERIAL));
    EXPECT(MISALIGNED, femto_rest_init(other, BYTES, nodes, NODES, (const void *)(work + 2), TETS, &MATERIAL));
    EXPECT(MISALIGNED, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, (const void *)(work + 3)));
    EXPECT(MISALIGNED, femto_state_init(other + 16, BYTES - 16, rest, BYTES, START));
    EXPECT(MISALIGNED, femto_place(state, BYTES, rest, BYTES, (const void *)(work + 1), velocities, NODES));
    EXPECT(MISALIGNED, femto_step(state + 4, BYTES - 4, rest, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(MISALIGNED, femto_step(state, BYTES, rest + 4, BYTES - 4, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(MISALIGNED, femto_step(state, BYTES, rest, BYTES, work + 4, BYTES - 4, &SETTINGS, &scene, NULL));
    EXPECT(MISALIGNED, step_with((const void *)(other + 1), &scene));
    EXPECT(MISALIGNED, step_with(&SETTINGS, (const void *)(other + 1)));
    EXPECT(MISALIGNED, femto_step(state, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, (void *)(other + 1)));
    EXPECT(MISALIGNED, femto_hash(state, BYTES, (void *)(other + 1)));
    EXPECT(MISALIGNED, femto_read(state, BYTES, NULL, NULL, (void *)(other + 1)));
    EXPECT(TOO_SMALL, femto_rest_init(other, rest_bytes - 1, nodes, NODES, tets, TETS, &MATERIAL));
    EXPECT(TOO_SMALL, femto_rest_init(other, 0, nodes, NODES, tets, TETS, &MATERIAL));
    EXPECT(TOO_SMALL, femto_rest_init(other, SIZE_MAX, nodes, NODES, tets, TETS, &MATERIAL));
    EXPECT(TOO_SMALL, femto_rest_init(other, BYTES, nodes, SIZE_MAX / 12, tets, TETS, &MATERIAL));
    EXPECT(TOO_SMALL, femto_rest_init(other, BYTES, nodes, NODES, tets, 0, &MATERIAL));
    EXPECT(TOO_SMALL, femto_state_init(other, state_bytes - 1, rest, BYTES, START));
    EXPECT(TOO_SMALL, femto_state_init(other, BYTES, rest, rest_bytes - 1, START));
    EXPECT(TOO_SMALL, femto_place(state, BYTES, rest, BYTES, nodes, velocities, NODES - 1));
    EXPECT(TOO_SMALL, femto_place(state, BYTES, rest, BYTES, nodes, velocities, 0));
    EXPECT(TOO_SMALL, femto_step(state, state_bytes - 1, rest, BYTES, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(TOO_SMALL, femto_step(state, BYTES, rest, rest_bytes - 1, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(TOO_SMALL, femto_step(state, BYTES, rest, BYTES, work, work_bytes - 1, &SETTINGS, &scene, NULL));
    EXPECT(TOO_SMALL, femto_hash(state, 8, &value));
    EXPECT(OVERLAP, femto_state_init(rest, BYTES, rest, BYTES, START));
    EXPECT(OVERLAP, femto_step(state, BYTES, rest, BYTES, state, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(OVERLAP, femto_step(state, BYTES, rest, BYTES, rest + 64, BYTES - 64, &SETTINGS, &scene, NULL));
    EXPECT(OVERLAP, femto_place(state, BYTES, rest, BYTES, (const void *)(state + 128), velocities, NODES));
    EXPECT(OVERLAP, femto_rest_init(other, BYTES, (const void *)(other + 256), NODES, tets, TETS, &MATERIAL));
    EXPECT(OVERLAP, femto_step(state, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, (void *)state));

    /* Meshes and materials. */
    uint32_t saved = tets[3][2];
    tets[3][2] = NODES;
    EXPECT(MESH, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, &MATERIAL));
    tets[3][2] = tets[3][1];
    EXPECT(MESH, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, &MATERIAL));
    tets[3][2] = saved;
    EXPECT(MESH, femto_rest_init(other, BYTES, nodes, NODES, tets, 1, &MATERIAL));
    FemtoMaterial material = MATERIAL;
    material.poisson = 0.5f;
    EXPECT(MATERIAL, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, &material));
    material = MATERIAL;
    material.young = 1e38f;
    material.poisson = 0.4999999f;
    EXPECT(MESH, femto_rest_init(other, BYTES, nodes, NODES, tets, TETS, &material));

    /* Settings. */
    FemtoSettings settings = SETTINGS;
    settings.dt = 0.0f;
    EXPECT(SETTINGS, step_with(&settings, &scene));
    settings = SETTINGS;
    settings.theta = NAN;
    EXPECT(SETTINGS, step_with(&settings, &scene));
    settings = SETTINGS;
    settings.preconditioner = 77;
    EXPECT(SETTINGS, step_with(&settings, &scene));
    settings = SETTINGS;
    settings.start = (FemtoStart){FEMTO_START_ZERO, 1};
    EXPECT(SETTINGS, step_with(&settings, &scene));
    settings.start = (FemtoStart){FEMTO_START_GALERKIN, 2}; /* More history than the state keeps. */
    EXPECT(SETTINGS, step_with(&settings, &scene));
    EXPECT(SETTINGS, femto_state_init(other, BYTES, rest, BYTES, (FemtoStart){5, 0}));

    /* Scenes. */
    const FemtoPin pin = {NODES, {0}};
    const FemtoCollider bad[] = {{7, {0, 1, 0}, 0, 0, {0}}, {FEMTO_COLLIDER_HALF_SPACE, {0}, 0, 0, {0}},
                                 {FEMTO_COLLIDER_SPHERE, {0}, -1, 0, {0}}, {FEMTO_COLLIDER_SPHERE, {0}, 1, -1, {0}},
                                 {FEMTO_COLLIDER_SPHERE, {0}, 1, 0, {NAN, 0, 0}}};
    FemtoScene wrong = scene;
    wrong.pins = &pin, wrong.pin_count = 1;
    EXPECT(SCENE, step_with(&SETTINGS, &wrong));
    wrong.pins = NULL;
    EXPECT(NULL, step_with(&SETTINGS, &wrong));
    wrong = scene, wrong.forces = (const void *)nodes, wrong.force_count = NODES - 1;
    EXPECT(SCENE, step_with(&SETTINGS, &wrong));
    wrong.forces = (const void *)(state + 128), wrong.force_count = NODES;
    EXPECT(OVERLAP, step_with(&SETTINGS, &wrong));
    wrong.forces = (const void *)(other + 1);
    EXPECT(MISALIGNED, step_with(&SETTINGS, &wrong));
    wrong.forces = (const void *)nodes, wrong.force_count = SIZE_MAX;
    EXPECT(TOO_SMALL, step_with(&SETTINGS, &wrong));
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        wrong = scene, wrong.colliders = bad + k, wrong.collider_count = 1;
        EXPECT(SCENE, step_with(&SETTINGS, &wrong));
    }
    FemtoCollider many[FEMTO_MAX_COLLIDERS + 1];
    for (int k = 0; k <= FEMTO_MAX_COLLIDERS; k++) many[k] = (FemtoCollider){FEMTO_COLLIDER_SPHERE, {9, 9, 9}, 1, 0, {0}};
    wrong = scene, wrong.colliders = many, wrong.collider_count = FEMTO_MAX_COLLIDERS + 1;
    EXPECT(SCENE, step_with(&SETTINGS, &wrong));
    wrong.colliders = NULL;
    EXPECT(NULL, step_with(&SETTINGS, &wrong));

    /* Not finite. */
    float far[NODES][3];
    memcpy(far, nodes, sizeof far);
    far[5][1] = INFINITY;
    EXPECT(NON_FINITE, femto_place(state, BYTES, rest, BYTES, (const float (*)[3])far, velocities, NODES));
    wrong = scene, wrong.gravity[0] = NAN;
    EXPECT(REFUSED, step_with(&SETTINGS, &wrong));

    if (hash() != before) {
        failures++;
        puts("a bad call changed the state");
    }
    const float(*x)[3] = NULL;
    EXPECT(OK, femto_read(state, BYTES, &x, NULL, &count));
    if (count != NODES || memcmp(x, nodes, sizeof nodes) != 0) {
        failures++;
        puts("positions are not those that were placed");
    }
}

/* The same for assets, factors and aggregates. */
static void bad_preconditioners(void) {
    const FemtoScene scene = {{0.0f, -9.81f, 0.0f}, NULL, 0, NULL, 0, NULL, 0};
    const size_t bytes = sizeof ASSET_LAPLACIAN, work_bytes = femto_workspace_bytes(NODES, TETS, START),
                 coarse_bytes = femto_coarse_bytes(AGGREGATES);
    FemtoAsset asset;
    EXPECT(OK, init());
    EXPECT(OK, femto_asset_open(ASSET_LAPLACIAN, bytes, &asset));
    const FemtoSettings factored = asset.settings;
    const uint64_t before = hash();

    /* Opening. */
    EXPECT(NULL, femto_asset_open(NULL, bytes, &asset));
    EXPECT(NULL, femto_asset_open(ASSET_LAPLACIAN, bytes, NULL));
    EXPECT(MISALIGNED, femto_asset_open(ASSET_LAPLACIAN + 4, bytes - 4, &asset));
    EXPECT(MISALIGNED, femto_asset_open(ASSET_LAPLACIAN, bytes, (void *)(work + 1)));
    EXPECT(TOO_SMALL, femto_asset_open(ASSET_LAPLACIAN, 32, &asset));
    EXPECT(TOO_SMALL, femto_asset_open(ASSET_LAPLACIAN, SIZE_MAX, &asset));
    EXPECT(ASSET, femto_asset_open(ASSET_LAPLACIAN, 64, &asset));
    EXPECT(ASSET, femto_asset_open(ASSET_LAPLACIAN, bytes - 32, &asset));
    EXPECT(ASSET, femto_asset_open(rest, BYTES, &asset));
    memcpy(other, ASSET_LAPLACIAN, bytes);
    EXPECT(OVERLAP, femto_asset_open(other, bytes, (void *)(other + 256)));
    EXPECT(ASSET, femto_asset_open(other, BYTES, &asset)); /* More bytes than the asset's. */
    for (size_t at = 0; at < bytes; at += 7) {
        other[at] ^= 0x10;
        EXPECT(ASSET, femto_asset_open(other, bytes, &asset));
        other[at] ^= 0x10;
    }
    EXPECT(OK, femto_asset_open(ASSET_NONE, sizeof ASSET_NONE, &asset));
    if (asset.settings.preconditioner != FEMTO_PRECONDITIONER_JACOBI || asset.settings.factor) {
        failures++;
        puts("a factor from nowhere");
    }

    /* The factor of a step. */
    FemtoSettings settings = factored;
    settings.factor = NULL;
    EXPECT(NULL, step_with(&settings, &scene));
    settings.factor = ASSET_LAPLACIAN + 4, settings.factor_bytes = bytes - 4;
    EXPECT(MISALIGNED, step_with(&settings, &scene));
    settings = factored, settings.factor_bytes = 32;
    EXPECT(TOO_SMALL, step_with(&settings, &scene));
    settings.factor_bytes = bytes - 32;
    EXPECT(ASSET, step_with(&settings, &scene));
    settings.factor = rest, settings.factor_bytes = BYTES;
    EXPECT(ASSET, step_with(&settings, &scene));
    settings.factor = ASSET_NONE, settings.factor_bytes = sizeof ASSET_NONE;
    EXPECT(ASSET, step_with(&settings, &scene));
    settings.factor = state, settings.factor_bytes = BYTES;
    EXPECT(OVERLAP, step_with(&settings, &scene));
    settings.factor = work, settings.factor_bytes = BYTES;
    EXPECT(OVERLAP, step_with(&settings, &scene));
    other[24] ^= 1; /* The fingerprint: of another mesh. */
    settings.factor = other, settings.factor_bytes = bytes;
    EXPECT(WRONG_BYTES, step_with(&settings, &scene));

    /* An asset in the place of rest data. */
    EXPECT(WRONG_BYTES, femto_step(state, BYTES, other, bytes, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(ASSET, femto_step(state, BYTES, ASSET_NONE, sizeof ASSET_NONE - 32, work, BYTES, &SETTINGS, &scene, NULL));
    EXPECT(ASSET, femto_state_init(work, BYTES, ASSET_NONE, 96, START));
    EXPECT(ASSET, femto_place(state, BYTES, ASSET_NONE, 96, nodes, velocities, NODES));

    /* Aggregates and their memory. */
    if (!coarse_bytes || femto_coarse_bytes(FEMTO_MAX_AGGREGATES + 1) || work_bytes + coarse_bytes > BYTES) {
        failures++;
        printf("coarse size %zu\n", coarse_bytes);
    }
    uint8_t of[NODES];
    EXPECT(NULL, femto_aggregates_init(NULL, NODES, rest, BYTES, AGGREGATES));
    EXPECT(NULL, femto_aggregates_init(of, NODES, NULL, BYTES, AGGREGATES));
    EXPECT(MISALIGNED, femto_aggregates_init(of, NODES, rest + 4, BYTES - 4, AGGREGATES));
    EXPECT(TOO_SMALL, femto_aggregates_init(of, NODES - 1, rest, BYTES, AGGREGATES));
    EXPECT(TOO_SMALL, femto_aggregates_init(of, NODES, rest, 64, AGGREGATES));
    EXPECT(OVERLAP, femto_aggregates_init(rest + 128, NODES, rest, BYTES, AGGREGATES));
    EXPECT(SETTINGS, femto_aggregates_init(of, NODES, rest, BYTES, FEMTO_MAX_AGGREGATES + 1));
    EXPECT(WRONG_BYTES, femto_aggregates_init(of, NODES, state, BYTES, AGGREGATES));
    EXPECT(OK, femto_aggregates_init(of, NODES, ASSET_NONE, sizeof ASSET_NONE, AGGREGATES));
    if (memcmp(of, aggregates, NODES) != 0) {
        failures++;
        puts("an asset is divided otherwise");
    }
    settings = TWO_LEVEL, settings.aggregates = NULL;
    EXPECT(NULL, step_with(&settings, &scene));
    settings.aggregates = state + 128;
    EXPECT(OVERLAP, step_with(&settings, &scene));
    settings.aggregates = work + 128;
    EXPECT(OVERLAP, step_with(&settings, &scene));
    settings = TWO_LEVEL, settings.aggregate_count = FEMTO_MAX_AGGREGATES + 1;
    EXPECT(SETTINGS, step_with(&settings, &scene));
    settings.aggregate_count = 1;
    EXPECT(SETTINGS, step_with(&settings, &scene));
    EXPECT(TOO_SMALL, femto_step(state, BYTES, rest, BYTES, work, work_bytes + coarse_bytes - 32, &TWO_LEVEL, &scene, NULL));

    if (hash() != before) {
        failures++;
        puts("a bad preconditioner changed the state");
    }
    EXPECT(OK, femto_step(state, BYTES, rest, BYTES, work, work_bytes + coarse_bytes, &TWO_LEVEL, &scene, NULL));
    EXPECT(OK, step_with(&factored, &scene)); /* An asset's factor, the same body's rest data. */
}

int main(void) {
    make_mesh();
    runs();
    bad_calls();
    bad_preconditioners();
    printf("%d failures\n", failures);
    return failures != 0;
}
