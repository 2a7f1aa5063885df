#pragma once

/// @file
/// One measured run of a scene on an engine.

#include "speed/quality.h"

#include <functional>

namespace speed {

/// Thrown out of a run when the user wants no more.
struct Interrupted
{};

struct RunOptions
{
    int steps = 0; ///< 0: as many as the scene says
    int threads = 1;
    int repeat = 1;
    bool discrete = false; ///< without continuous collision
    int finer = 1;         ///< steps of the scene are parted into so many each
    int disturbed = 0; ///< above 0: the quality is that of so many more runs, whose bodies start off their places by up to 0.1 mm
    std::function<void(const std::string&)> progress = [](const std::string&) {}; ///< may throw Interrupted
};

struct Result
{
    std::string scene{};
    std::string engine{};
    std::string isa{};
    int threads = 1;
    int bodies = 0;
    int joints = 0;
    int contacts = 0;
    int steps = 0;
    double ms = 0;     ///< all steps but the first, the fastest of the repetitions
    double cpu_ms = 0; ///< processor time of the same steps, all threads: what a busy machine leaves comparable
    Stages stages{};   ///< of the fastest one, ms
    bool has_stages = false;
    std::uint64_t hash = 0;
    bool repeats = true; ///< every repetition ended in the same state
    Quality quality{};   ///< over the last half of the first repetition, or of the disturbed runs
    double bytes_per_body = none;
    double bytes_per_contact = none;
    double peak_mb = 0;
};

/// The time that Box2D's own benchmark program takes: everything from the second step on. Samples for the quality are taken between the
/// steps, with the clock stopped.
[[nodiscard]] Result run(const carom::scenes::SceneEntry& entry, const Contender& contender, const RunOptions& options);

/// Hashes after every 20th step and after the last one.
[[nodiscard]] std::vector<std::uint64_t> hashes(const carom::scenes::SceneEntry& entry, const Contender& contender,
                                                const RunOptions& options);
inline constexpr int hash_interval = 20;

/// The median of at least one value; the values are reordered.
[[nodiscard]] double median(std::vector<double>& values);

} // namespace speed
