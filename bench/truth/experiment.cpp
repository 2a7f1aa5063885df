#include "truth/experiments/experiments.h"

#include <algorithm>
#include <array>

namespace truth {

std::span<const Experiment> experiments()
{
    static const std::array list{
        Experiment{1, "a ball that loses nothing", elastic_ball},
        Experiment{2, "restitution", restitution},
        Experiment{3, "two discs", two_discs},
        Experiment{4, "a box lands on a corner", box_corner},
        Experiment{5, "inclines", inclines},
        Experiment{6, "pendulums", pendulums},
        Experiment{7, "springs", springs},
        Experiment{8, "Newton's cradle", cradle},
        Experiment{9, "billiards", billiards},
        Experiment{10, "nothing passes through", tunneling},
        Experiment{11, "sensors", sensors},
        Experiment{12, "stacks", stacks, false},
        Experiment{13, "chains", chains, false},
        Experiment{14, "a pile of a thousand", pile, false},
        Experiment{15, "the flipper shot", flipper_shot},
        Experiment{16, "a gas", gas},
        Experiment{17, "long cradles", long_rows},
        Experiment{18, "a pool shot beside others", spectators},
        Experiment{19, "blows to joints", struck_joints},
        Experiment{20, "linkages", linkages},
        Experiment{21, "long chains", long_chains},
        Experiment{22, "nets of springs", spring_nets},
        Experiment{23, "a rocking block", rocking},
        Experiment{24, "a loaded cart on ice", carts},
    };
    return list;
}

const Experiment* find_experiment(int number)
{
    const std::span<const Experiment> all = experiments();
    const auto found = std::find_if(all.begin(), all.end(), [number](const Experiment& e) { return e.number == number; });
    return found == all.end() ? nullptr : &*found;
}

bool converges(const Metric& coarse, const Metric& fine)
{
    return fine.error() <= coarse.error() / 2 || fine.error() <= fine.bound / 4;
}

} // namespace truth
