#pragma once

/// @file
/// An experiment takes an engine and a step and gives metrics: a value beside the exact one and how far off it may be.

#include "truth/world.h"

#include <atomic>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace truth {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Metric
{
    int experiment = 0;
    std::string name{};
    double exact = 0;
    double value = none; ///< none where the engine cannot do it
    double bound = none; ///< largest allowed distance of value from exact; none: measured and reported

    [[nodiscard]] double error() const { return std::abs(value - exact); }
    [[nodiscard]] bool has_bound() const { return !std::isnan(bound); }
    [[nodiscard]] bool ok() const { return !has_bound() || error() <= bound; }
};

/// Thrown out of an experiment when the user stops the program.
struct Interrupted
{};

/// How an experiment is run.
struct Setup
{
    Engine engine{};
    double hz = 60;
    /// Fraction of the cases to run, for slow builds; 1 is the definition.
    double share = 1;
    std::function<void(const std::string&)> progress{}; ///< may throw Interrupted

    [[nodiscard]] double dt() const { return 1 / hz; }
    [[nodiscard]] int steps(double seconds) const { return static_cast<int>(std::lround(seconds * hz)); }
    [[nodiscard]] int cases(int count) const { return std::max(1, static_cast<int>(std::lround(count * share))); }
    [[nodiscard]] std::unique_ptr<World> world(Vec gravity = {}) const { return engine.make_world({.gravity = gravity}); }
    void tell(const std::string& what) const
    {
        if (progress)
        {
            progress(what);
        }
    }
};

inline constexpr Vec earth{0, -9.81};

using Metrics = std::vector<Metric>;

struct Experiment
{
    int number = 0;
    std::string title{};
    Metrics (*run)(const Setup& setup) = nullptr;
    /// Whether the errors have to shrink with the step. What is at rest has errors of another kind: they are kept below a peer's.
    bool shrinks = true;
};

[[nodiscard]] std::span<const Experiment> experiments();
/// The one with this number; null if there is none.
[[nodiscard]] const Experiment* find_experiment(int number);

/// Errors shrink with the step: the finer one's error is at most half of the coarser one's, or below a quarter of the bound.
[[nodiscard]] bool converges(const Metric& coarse, const Metric& fine);

} // namespace truth
