/* The interface from C, on a host or as firmware: the scene "contact" of examples/cases, whose hashes after 1, 20 and
 * 1,000 steps it prints in the form of golden.txt, and every bad call, which must return its code. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "../femto.h"

enum { NODES = 16, TETS = 18, BYTES = 8192 };

static _Alignas(FEMTO_ALIGNMENT) unsigned char rest[BYTES], state[BYTES], work[BYTES], other[BYTES];
static float nodes[NODES][3], velocities[NODES][3];
static uint32_t tets[TETS][4];

static const FemtoMaterial MATERIAL = {2e4f, 0.4f, 1000.0f, 0.05f, 1e-4f};
static const FemtoStart START = {FEMTO_START_GALERKIN, 1};
static const FemtoSettings SETTINGS = {1.0f / 150.0f, 1.0f, 5, 2, {FEMTO_START_GALERKIN, 1}, FEMTO_PRECONDITIONER_JACOBI};

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
static void replay(const FemtoScene *scene) {
    uint64_t first = 0;
    memcpy(other, state, BYTES);
    for (int turn = 0; turn < 2; turn++) {
        for (int k = 0; k < 3; k++)
            EXPECT(OK, femto_step(state, BYTES, rest, BYTES, work, BYTES, &SETTINGS, scene, NULL));
        if (turn == 1 && hash() != first) {
            failures++;
            puts("a replay has other bits");
        }
        first = hash();
        memcpy(state, other, BYTES);
    }
}

static void run(void) {
    FemtoCollider colliders[2] = {
        {FEMTO_COLLIDER_HALF_SPACE, {0.1f, 1.0f, 0.05f}, 0.0f, 0.4f, {0}},
        {FEMTO_COLLIDER_SPHERE, {0.5f, -0.5f, 0.1f}, 0.45f, 0.2f, {0.01f, 0.0f, 0.02f}},
    };
    const FemtoScene scene = {{0.0f, -9.81f, 0.0f}, NULL, 0, NULL, 0, colliders, 2};
    EXPECT(OK, init());
    for (int step = 1; step <= 1000; step++) {
        FemtoReport report;
        EXPECT(OK, femto_step(state, BYTES, rest, BYTES, work, BYTES, &SETTINGS, &scene, &report));
        if (step == 10) replay(&scene);
        for (int axis = 0; axis < 3; axis++) colliders[1].vector[axis] += colliders[1].velocity[axis] * SETTINGS.dt;
        if (step == 1 || step == 20 || step == 1000)
            printf("scene contact %d %08lx%08lx\n", step, (unsigned long)(hash() >> 32), (unsigned long)(hash() & 0xffffffffu));
    }
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

int main(void) {
    make_mesh();
    run();
    bad_calls();
    printf("%d failures\n", failures);
    return failures != 0;
}
