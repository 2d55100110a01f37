/* Reset of a Cortex-M4F under QEMU: FPU on, memory as C wants it, semihosting, main. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t _data_from[], _data[], _data_end[], _bss[], _bss_end[], _stack_top[];
extern void initialise_monitor_handles(void);
extern int main(void);

void reset(void);
void fault(void);

__attribute__((used, section(".vectors"))) static const uintptr_t VECTORS[16] = {
    (uintptr_t)_stack_top, (uintptr_t)reset, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault};

void reset(void) {
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20; /* CPACR: full access to CP10 and CP11 */
    __asm volatile("dsb\n isb");
    for (uint32_t *to = _data, *from = _data_from; to < _data_end;) *to++ = *from++;
    for (uint32_t *to = _bss; to < _bss_end;) *to++ = 0;
    initialise_monitor_handles();
    exit(main());
}

void fault(void) { _Exit(3); }
