#pragma once

/// @file
/// Runs an experiment on Carom and checks what it gives.

#include "support/effort.h"
#include "truth/experiment.h"

#include <gtest/gtest.h>

namespace truth::test {

using carom::test::does_whole_tests;
using carom::test::slow_build;

inline Metrics run(int number, double hz, double share = 1, const Engine& engine = carom_engine())
{
    return find_experiment(number)->run({.engine = engine, .hz = hz, .share = share});
}

inline void expect_bounds(const Metrics& metrics)
{
    int bounded = 0;
    for (const Metric& m : metrics)
    {
        bounded += m.has_bound() ? 1 : 0;
        EXPECT_TRUE(m.ok()) << m.name << ": " << m.value << ", exact " << m.exact << ", bound " << m.bound;
    }
    EXPECT_GT(bounded, 0);
}

/// At the default step.
inline void expect_bounds(int number) { expect_bounds(run(number, 60)); }

/// Errors at 1/240 s are at most half of those at 1/60 s, or below a quarter of the bound.
inline void expect_shrinking(int number)
{
    const Metrics coarse = run(number, 60);
    const Metrics fine = run(number, 240);
    ASSERT_EQ(coarse.size(), fine.size());
    for (std::size_t i = 0; i < coarse.size(); ++i)
    {
        EXPECT_TRUE(!fine[i].has_bound() || converges(coarse[i], fine[i]))
            << fine[i].name << ": error " << coarse[i].error() << " at 60 Hz, " << fine[i].error() << " at 240 Hz, bound "
            << fine[i].bound;
    }
}

} // namespace truth::test
