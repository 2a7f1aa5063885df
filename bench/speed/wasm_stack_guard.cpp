// Debian builds the C++ library for WebAssembly with stack guards, and the C library without.

extern "C" {
extern unsigned long __stack_chk_guard;
unsigned long __stack_chk_guard = 0;
[[noreturn]] void __stack_chk_fail();
[[noreturn]] void __stack_chk_fail() { __builtin_trap(); }
}
