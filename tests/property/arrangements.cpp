#include "property/arrangements.h"

namespace carom::shots {

std::span<const Arrangement> arrangements()
{
    static constexpr Arrangement list[] = {
        {"BallAtWall", 5000, ball_at_wall},
        {"BallAtBody", 5000, ball_at_body},
        {"BallAtArc", 3000, ball_at_arc},
        {"BallAtClosedChain", 3000, ball_at_closed_chain},
        {"BallInRoom", 5000, ball_in_room},
        {"BallInRoundRoom", 4000, ball_in_round_room},
        {"BallInWedge", 3000, ball_in_wedge},
        {"PieceAtWall", 5000, piece_at_wall},
        {"PieceInRoom", 5000, piece_in_room},
        {"PieceInRoundRoom", 4000, piece_in_round_room},
        {"PieceInWedge", 3000, piece_in_wedge},
        {"BallPair", 5000, ball_pair},
        {"StraightPair", 4000, straight_pair},
        {"SpinningPair", 5000, spinning_pair},
        {"Tube", 5000, tube},
        {"BallAtPlate", 4000, ball_at_plate},
        {"PieceAtPlate", 3000, piece_at_plate},
        {"BallAtTurningBar", 4000, ball_at_turning_bar},
        {"Drum", 3000, drum},
        {"FlipperChamber", 4000, flipper_chamber},
        {"ThroughTrigger", 4000, ball_through_trigger},
        {"Crowd", 4000, crowd},
        {"Pile", 3000, pile},
        {"PendulumStruck", 3000, pendulum_struck},
        {"JointsInRoom", 3000, joints_in_room},
        {"SpringsInRoom", 1000, springs_in_room},
        {"Company", 300, company},
        {"LinkageInRoom", 1000, linkage_in_room},
    };
    return list;
}

} // namespace carom::shots
