#pragma once

/// @file
/// The arrangements: each builds one random scene in which it is known what may not happen.

#include "property/trial.h"

#include <span>

namespace carom::shots {

struct Arrangement
{
    const char* name;
    int shots; ///< of the 100,000
    void (*build)(Trial&);
};

/// All of them; the numbers of the shots run through this list.
[[nodiscard]] std::span<const Arrangement> arrangements();

// walls.cpp: one static target, the shot in front of it
void ball_at_wall(Trial& trial);
void piece_at_wall(Trial& trial);
void ball_at_body(Trial& trial);
void ball_at_arc(Trial& trial);
void ball_at_closed_chain(Trial& trial);

// closed_rooms.cpp
void ball_in_room(Trial& trial);
void ball_in_round_room(Trial& trial);
void ball_in_wedge(Trial& trial);
void piece_in_room(Trial& trial);
void piece_in_round_room(Trial& trial);
void piece_in_wedge(Trial& trial);
void drum(Trial& trial);
void tube(Trial& trial);
void crowd(Trial& trial);
void pile(Trial& trial);

// pairs.cpp: two free bodies
void ball_pair(Trial& trial);
void straight_pair(Trial& trial);
void spinning_pair(Trial& trial);

// moving.cpp: kinematic targets
void ball_at_plate(Trial& trial);
void piece_at_plate(Trial& trial);
void ball_at_turning_bar(Trial& trial);

// flippers.cpp
void flipper_chamber(Trial& trial);

// triggers.cpp
void ball_through_trigger(Trial& trial);

// jointed.cpp
void pendulum_struck(Trial& trial);
void joints_in_room(Trial& trial);
void springs_in_room(Trial& trial);
void company(Trial& trial); ///< of 17 to 200
void linkage_in_room(Trial& trial);

} // namespace carom::shots
