#include "truth/engines/engines.h"

namespace truth {

std::vector<Engine> engines()
{
    std::vector<Engine> result{carom_engine()};
#ifdef TRUTH_HAS_BOX2D
    result.push_back(box2d_engine());
#endif
#ifdef TRUTH_HAS_BOX2D3
    result.push_back(box2d3_engine());
#endif
#ifdef TRUTH_HAS_CHIPMUNK
    result.push_back(chipmunk_engine());
#endif
    return result;
}

} // namespace truth
