#pragma once

// Asserts for the library's own invariants. Bad input from users never gets here: public functions refuse it first.

#include <cstdio>
#include <cstdlib>

#if !defined(NDEBUG) || defined(CAROM_VALIDATE)
#define CAROM_ASSERT(condition, sentence)                                                                                        \
    do                                                                                                                           \
    {                                                                                                                            \
        if (!(condition))                                                                                                        \
        {                                                                                                                        \
            std::fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, sentence, #condition);                                  \
            std::abort();                                                                                                        \
        }                                                                                                                        \
    } while (false)
#else
#define CAROM_ASSERT(condition, sentence) static_cast<void>(0)
#endif
