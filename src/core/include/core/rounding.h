#pragma once

// Rounding to nearest within a scope: results do not depend on the rounding mode that the host program has set.

#include <cfenv>

namespace carom::internal {

class RoundToNearest
{
public:
    RoundToNearest() : m_before(std::fegetround())
    {
        if (m_before != FE_TONEAREST)
            std::fesetround(FE_TONEAREST);
    }
    ~RoundToNearest()
    {
        if (m_before != FE_TONEAREST)
            std::fesetround(m_before);
    }
    RoundToNearest(const RoundToNearest&) = delete;
    RoundToNearest& operator=(const RoundToNearest&) = delete;

private:
    int m_before;
};

} // namespace carom::internal
