#pragma once

/// @file
/// The single checks behind check(), each in the file of its subject.

#include "pinball/table/checker.h"
#include "pinball/table/number_text.h"
#include "pinball/table/obstacles.h"
#include "pinball/table/reach.h"

namespace carom::pinball {

/// Deeper than this is an overlap; parts that are meant to touch are written with rounded numbers.
inline constexpr double touch_tolerance = 0.00005; ///< m

struct CheckContext
{
    const Table& table;
    std::vector<Obstacle> obstacles;
    std::vector<Point> outline;
    Reach reach;        ///< of the ball in play
    double ball_radius; ///< m
    std::vector<Finding> findings{};

    explicit CheckContext(const Table& checked);
    void report(FindingKind kind, std::vector<Index> elements, Point where, std::string sentence);
    [[nodiscard]] const std::string& id(Index element) const { return table.elements[element].id; }
};

void check_outlines(CheckContext& context); // check_places.cpp
void check_places(CheckContext& context);
void check_drains(CheckContext& context);
void check_leaks(CheckContext& context);
void check_reachable(CheckContext& context);
/// True if the ball is free to leave its start: only then does where it can get to mean anything.
[[nodiscard]] bool check_start(CheckContext& context); // check_overlaps.cpp
void check_device_overlaps(CheckContext& context);
void check_flipper_strokes(CheckContext& context); // check_strokes.cpp
void check_flippers(CheckContext& context);
void check_travel(CheckContext& context);
void check_narrow_gaps(CheckContext& context);    // check_gaps.cpp
void check_resting_places(CheckContext& context); // check_rests.cpp
void check_steps(CheckContext& context);          // check_steps.cpp

} // namespace carom::pinball
