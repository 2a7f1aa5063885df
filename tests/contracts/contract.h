#pragma once

/// @file
/// The fixture of all tests of refusals: a scene with one of everything, and calls that must be refused.

#include "support/test_scene.h"

#include <initializer_list>
#include <limits>

namespace carom::test {

inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinite = std::numeric_limits<float>::infinity();

// A scene with one of everything, and one of everything destroyed.
class Contract : public ::testing::Test
{
protected:
    Scene scene{SceneDef{}};
    Thing fixed = add_static(scene, box(10, 0.5f));
    Thing ball = add_dynamic(scene, {0, 3}, Circle{});
    Thing crate = add_dynamic(scene, {2, 3}, box(0.5f, 0.5f));
    Thing bar = add(scene, {.type = BodyType::Kinematic, .position = {-4, 5}}, Capsule{});
    Thing zone = add_static(scene, box(1, 1, {0, 8}), {.trigger = true});
    JointId joint = scene.create_joint(SpringDef{.body_a = ball.body, .body_b = crate.body, .stiffness = 10});
    JointId hinge = scene.create_joint(RevoluteDef{.body_b = crate.body, .anchor_a = {2, 3}});
    Thing gone = make_gone();
    JointId gone_joint = make_gone_joint();

    Thing make_gone()
    {
        const Thing t = add_dynamic(scene, {9, 9}, Circle{});
        scene.destroy(t.body);
        return t;
    }
    JointId make_gone_joint()
    {
        const JointId id = scene.create_joint(SpringDef{.body_a = ball.body, .body_b = crate.body});
        scene.destroy(id);
        return id;
    }

    // Refused with a sentence that has each of the words; nothing changed.
    template <class Call>
    void refused(Call&& call, std::initializer_list<const char*> words)
    {
        const std::uint64_t before = scene.state_hash();
        const std::size_t bodies = scene.bodies().size();
        const std::size_t joints = scene.joints().size();
        try
        {
            call();
            ADD_FAILURE() << "not refused: " << *words.begin() << ", " << *(words.end() - 1);
        }
        catch (const Error& error)
        {
            const std::string sentence = error.what();
            for (const char* word : words)
                EXPECT_NE(sentence.find(word), std::string::npos) << "no '" << word << "' in: " << sentence;
            EXPECT_EQ(sentence.find('\n'), std::string::npos) << "one sentence: " << sentence;
        }
        EXPECT_EQ(scene.state_hash(), before) << *words.begin() << ", " << *(words.end() - 1);
        EXPECT_EQ(scene.bodies().size(), bodies);
        EXPECT_EQ(scene.joints().size(), joints);
    }

    void body_refused(const BodyDef& def, const char* field)
    {
        refused([&] { static_cast<void>(scene.create_body(def)); }, {"Scene::create_body", field});
    }
    template <class Call>
    void verb_refused(const char* name, const char* field, Call&& call)
    {
        refused([&] { call(scene.body(ball.body)); }, {name, field});
    }
    void geometry_refused(const Geometry& geometry, const char* field, BodyId body)
    {
        refused([&] { scene.create_shape(body, geometry); }, {"Scene::create_shape", field});
    }
    void geometry_refused(const Geometry& geometry, const char* field)
    {
        geometry_refused(geometry, field, ball.body);
        refused([&] { scene.shape(ball.shape).set_geometry(geometry); }, {"Shape::set_geometry", field});
        refused([&] { static_cast<void>(scene.overlap_shape(geometry, {})); }, {"Scene::overlap_shape", field});
    }
    void def_refused(const ShapeDef& def, const char* field)
    {
        refused([&] { scene.create_shape(ball.body, Circle{}, def); }, {"Scene::create_shape", field});
        refused([&] { scene.shape(ball.shape).set_def(def); }, {"Shape::set_def", field});
    }
    template <class Def>
    void joint_refused(const Def& def, const char* field)
    {
        refused([&] { scene.create_joint(def); }, {"Scene::create_joint", field});
    }
};

} // namespace carom::test
