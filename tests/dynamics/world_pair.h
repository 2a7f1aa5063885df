#pragma once

// Two worlds alike, of which the second never keeps rows or hinges: they must come out the same, whatever happens between steps.

#include "dynamics/state/scene_data.h"
#include "support/test_scene.h"

#include <string>
#include <vector>

namespace carom::test {

struct World
{
    explicit World(bool sleeps) : scene(SceneDef{.sleeping = sleeps}) {}

    Scene scene;
    BodyId ground{};
    std::vector<BodyId> bodies{};
};

inline void expect_same_contacts(const World& a, const World& b, const std::string& when)
{
    const std::vector<ContactInfo> of_a = a.scene.contacts();
    const std::vector<ContactInfo> of_b = b.scene.contacts();
    ASSERT_EQ(of_a.size(), of_b.size()) << when;
    for (std::size_t i = 0; i < of_a.size(); ++i)
    {
        ASSERT_EQ(of_a[i].normal, of_b[i].normal) << when;
        ASSERT_EQ(of_a[i].point_count, of_b[i].point_count) << when;
        ASSERT_EQ(of_a[i].color, of_b[i].color) << when;
        for (int p = 0; p < of_a[i].point_count; ++p)
        {
            ASSERT_EQ(of_a[i].points[p].position, of_b[i].points[p].position) << when << ", contact " << i;
            ASSERT_EQ(of_a[i].points[p].separation, of_b[i].points[p].separation) << when << ", contact " << i;
            ASSERT_EQ(of_a[i].points[p].normal_impulse, of_b[i].points[p].normal_impulse) << when << ", contact " << i;
        }
    }
}

class WorldPair
{
public:
    template <class Build>
    WorldPair(bool sleeps, const Build& build) : m_followed(sleeps), m_anew(sleeps)
    {
        build(m_followed);
        build(m_anew);
    }

    template <class Happens>
    void both(const Happens& happens)
    {
        happens(m_followed);
        happens(m_anew);
    }

    // How many of the steps were taken with rows in place.
    int run(int steps_taken, float dt = 1.0f / 60)
    {
        int stayed = 0;
        for (int i = 0; i < steps_taken && !testing::Test::HasFailure(); ++i)
        {
            m_anew.scene.data().state.lanes_stamp = 0; // what is in the rows is another state's
            both([dt](World& w) { w.scene.step(dt); });
            stayed += constraints_are_unchanged() ? 1 : 0;
            const std::string when = "step " + std::to_string(m_followed.scene.step_count());
            EXPECT_EQ(m_anew.scene.data().scratch.reuse, internal::Reuse::Nothing);
            EXPECT_EQ(m_followed.scene.state_hash(), m_anew.scene.state_hash()) << when;
            EXPECT_EQ(m_followed.scene.report().touching, m_anew.scene.report().touching) << when;
            EXPECT_EQ(m_followed.scene.report().pairs, m_anew.scene.report().pairs) << when;
            EXPECT_EQ(m_followed.scene.report().colors, m_anew.scene.report().colors) << when;
            if (i % 10 == 0)
                expect_same_contacts(m_followed, m_anew, when);
        }
        return stayed;
    }

    [[nodiscard]] bool constraints_are_unchanged()
    {
        return m_followed.scene.data().scratch.reuse == internal::Reuse::Constraints;
    }
    [[nodiscard]] bool hinges_are_unchanged() { return m_followed.scene.data().scratch.reuse != internal::Reuse::Nothing; }
    [[nodiscard]] const World& followed() const { return m_followed; }
    [[nodiscard]] const World& anew() const { return m_anew; }

private:
    World m_followed;
    World m_anew;
};

} // namespace carom::test
