#pragma once

#include "carom/scene.h"

#include <thread>
#include <vector>

namespace carom::test {

/// So many threads, new ones for each call: of three the first takes tasks 0, 3, 6 and so on. Outlives the scenes that have its hooks.
class Threads
{
public:
    explicit Threads(int count) : m_count(count) {}

    [[nodiscard]] TaskHooks hooks() { return {.worker_count = m_count, .run = run, .user = this}; }

private:
    static void run(void* user, int count, void (*task)(void*, int), void* context)
    {
        const int step = static_cast<const Threads*>(user)->m_count;
        std::vector<std::thread> threads;
        for (int first = 0; first < step; ++first)
            threads.emplace_back(
                [=]
                {
                    for (int i = first; i < count; i += step)
                        task(context, i);
                });
        for (std::thread& thread : threads)
            thread.join();
    }

    int m_count;
};

/// TaskHooks::run on one thread, the last task first: order must not matter.
inline void run_backwards(void*, int count, void (*task)(void*, int), void* context)
{
    for (int i = count; i-- > 0;)
        task(context, i);
}

} // namespace carom::test
