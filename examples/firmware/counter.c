/* A QEMU plugin that counts instructions between two marker functions.
 *
 *     cc -shared -fPIC -O2 -o counter.so counter.c
 *     qemu-… -plugin counter.so,begin=0xADDRESS,end=0xADDRESS[,aside=0xADDRESS,back=0xADDRESS][,profile=FILE] …
 *
 * Each time `end` is called it prints the number of instructions since `begin`, as a line on standard output: the
 * program under test writes what it belongs to before. From a call of `aside` to one of `back` they are counted
 * by themselves, and follow on the line if there were any. (Addresses are taken without the last bit, which marks
 * Thumb.) With `profile`, a table of address and instructions of each
 * translated block follows at exit. Debian's QEMU has no header for plugins; what is needed is declared here (API
 * version 1, QEMU 5.2 and later). */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
uint64_t qemu_plugin_tb_vaddr(const struct qemu_plugin_tb *);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *, void (*)(unsigned, void *), int flags, void *);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void *), void *);

int qemu_plugin_version = 1;

/* A translated block. A call ends a block, so a marker function begins one. */
struct block {
    uint64_t address, instructions, runs;
    enum { INSIDE, BEGIN, END, ASIDE, BACK } kind;
    struct block *next;
};

static uint64_t begin, end, away, back;
/* In the open, and aside. */
static uint64_t count[2];
static bool counting;
static int where;
static struct block *blocks;
static const char *profile;

static void executed(unsigned cpu, void *data) {
    struct block *block = data;
    (void)cpu;
    if (block->kind == ASIDE || block->kind == BACK) where = block->kind == ASIDE;
    if (block->kind == BEGIN) {
        count[0] = count[1] = 0;
        where = 0;
        counting = true;
    } else if (block->kind == END) {
        char line[64];
        int length = count[1] ? snprintf(line, sizeof line, "%" PRIu64 " %" PRIu64 "\n", count[0], count[1])
                              : snprintf(line, sizeof line, "%" PRIu64 "\n", count[0]);
        counting = false;
        if (write(STDOUT_FILENO, line, (size_t)length) != length) abort();
    } else if (counting) {
        count[where] += block->instructions;
        block->runs++;
    }
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *tb) {
    struct block *block = calloc(1, sizeof *block);
    (void)id;
    if (!block) abort();
    block->address = qemu_plugin_tb_vaddr(tb);
    block->instructions = qemu_plugin_tb_n_insns(tb);
    block->kind = block->address == begin ? BEGIN : block->address == end ? END
                : block->address == away ? ASIDE : block->address == back ? BACK : INSIDE;
    block->next = blocks;
    blocks = block;
    qemu_plugin_register_vcpu_tb_exec_cb(tb, executed, 0, block);
}

static void exiting(qemu_plugin_id_t id, void *data) {
    (void)id;
    (void)data;
    FILE *file = profile ? fopen(profile, "w") : NULL;
    if (!file) return;
    for (struct block *block = blocks; block; block = block->next)
        if (block->runs) fprintf(file, "%#" PRIx64 " %" PRIu64 "\n", block->address, block->runs * block->instructions);
    fclose(file);
}

int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int argc, char **argv) {
    (void)info;
    for (int i = 0; i < argc; i++) {
        if (!strncmp(argv[i], "begin=", 6)) begin = strtoull(argv[i] + 6, NULL, 0) & ~UINT64_C(1);
        if (!strncmp(argv[i], "end=", 4)) end = strtoull(argv[i] + 4, NULL, 0) & ~UINT64_C(1);
        if (!strncmp(argv[i], "aside=", 6)) away = strtoull(argv[i] + 6, NULL, 0) & ~UINT64_C(1);
        if (!strncmp(argv[i], "back=", 5)) back = strtoull(argv[i] + 5, NULL, 0) & ~UINT64_C(1);
        if (!strncmp(argv[i], "profile=", 8)) profile = strdup(argv[i] + 8);
    }
    if (!begin || !end) {
        fprintf(stderr, "counter: begin=ADDRESS,end=ADDRESS is missing\n");
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, exiting, NULL);
    return 0;
}
