// 10,000 random operations: every enter has exactly one exit by the end, and there are never two enters in a row.

#include "support/test_scene.h"

#include <map>

using namespace carom;
using namespace carom::test;

namespace {

struct Ledger
{
    std::map<std::pair<ShapeId, ShapeId>, int> open;
    long enters = 0;
    long exits = 0;

    void read(const Scene& scene)
    {
        // In the order of time, exits of the same moment before enters only where that is how it happened: a pair's events alternate, so
        // take whichever fits.
        std::map<std::pair<ShapeId, ShapeId>, std::pair<int, int>> step;
        for (const TriggerEvent& e : scene.trigger_enters())
        {
            ++enters;
            ++step[{e.trigger, e.visitor}].first;
        }
        for (const TriggerEvent& e : scene.trigger_exits())
        {
            ++exits;
            ++step[{e.trigger, e.visitor}].second;
        }
        for (const auto& [pair, counts] : step)
        {
            int& state = open[pair];
            state += counts.first - counts.second;
            ASSERT_TRUE(state == 0 || state == 1)
                << "trigger " << pair.first.slot << " visitor " << pair.second.slot << " state " << state << " after "
                << counts.first << " enters and " << counts.second << " exits";
        }
    }
};

Geometry random_geometry(Random& random, bool may_be_massless)
{
    switch (random.below(may_be_massless ? 6 : 4))
    {
    case 0: return Circle{.radius = random.rangef(0.1, 0.6)};
    case 1: return box(random.rangef(0.1, 0.6), random.rangef(0.1, 0.6));
    case 2: return Capsule{{-0.3f, 0}, {0.3f, 0}, 0.2f, 0.1f};
    case 3: return Segment{{-0.5f, 0}, {0.5f, 0}, 0.05f};
    case 4: return Arc{.radius = 0.5f};
    default: return Chain{.start = {-1, 0}, .pieces = {{.end = {0, 0}}, {.end = {1, 0.5f}, .sweep = 1}}};
    }
}

void run(std::uint64_t seed, int operations)
{
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    SceneDef def;
    def.gravity = {0, -2};
    Scene scene(def);
    add_static(scene, HalfSpace{.offset = -6});
    Ledger ledger;
    std::vector<BodyId> bodies;
    const auto position = [&] { return Position{random.range(-5, 5), random.range(-5, 5)}; };
    for (int i = 0; i < operations; ++i)
    {
        SCOPED_TRACE("operation " + std::to_string(i));
        const int what = random.below(14);
        if (bodies.size() < 15 || (what == 0 && bodies.size() < 60))
        {
            const auto type = static_cast<BodyType>(random.below(3));
            const BodyId body = scene.create_body({.type = type,
                                                   .position = position(),
                                                   .velocity = random.vec(random.chance(0.2) ? 300 : 3),
                                                   .awake = random.chance(0.8)});
            const int shapes = 1 + random.below(2);
            for (int k = 0; k < shapes; ++k)
                scene.create_shape(body, random_geometry(random, type == BodyType::Static),
                                   {.restitution = 0.5f, .trigger = random.chance(0.4)});
            bodies.push_back(body);
        }
        else
        {
            const std::size_t index = static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())));
            const BodyId id = bodies[index];
            Body body = scene.body(id);
            const std::vector<ShapeId> shapes = body.shapes();
            const ShapeId shape =
                shapes.empty() ? ShapeId{} : shapes[static_cast<std::size_t>(random.below(static_cast<int>(shapes.size())))];
            switch (what)
            {
            case 1:
                scene.destroy(id);
                bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(index));
                break;
            case 2:
                if (!shape.is_null())
                    scene.destroy(shape);
                break;
            case 3: body.teleport(position(), random.rangef(-3, 3)); break;
            case 4: body.set_enabled(!body.is_enabled()); break;
            case 5:
            {
                try
                {
                    body.set_type(static_cast<BodyType>(random.below(3)));
                }
                catch (const Error&)
                { // an arc or a chain cannot move freely
                }
                break;
            }
            case 6:
                if (!shape.is_null())
                {
                    ShapeDef d = scene.shape(shape).def();
                    d.filter.mask = random.chance(0.3) ? 0 : ~std::uint64_t{0};
                    scene.shape(shape).set_def(d);
                }
                break;
            case 7:
                if (!shape.is_null())
                {
                    ShapeDef d = scene.shape(shape).def();
                    d.trigger = !d.trigger;
                    scene.shape(shape).set_def(d);
                }
                break;
            case 8: body.set_awake(false); break;
            case 9: body.set_velocity(random.vec(random.chance(0.3) ? 500 : 4)); break;
            case 10:
                if (!shape.is_null() && body.type() != BodyType::Static)
                    scene.shape(shape).set_geometry(random_geometry(random, false));
                break;
            case 11:
            {
                const BodyId other = bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))];
                if (other != id && random.chance(0.5))
                    scene.ignore_pair(id, other);
                else if (other != id)
                    scene.restore_pair(id, other);
                break;
            }
            case 12:
                if (body.type() == BodyType::Kinematic)
                    body.set_target_pose(position(), 0);
                break;
            default: scene.create_shape(id, random_geometry(random, false), {.trigger = random.chance(0.4)}); break;
            }
        }
        if (random.chance(0.5))
        {
            scene.step(1.0f / 60);
            ledger.read(scene);
            if (::testing::Test::HasFailure())
                return;
            // The scene's list of visitors must be the one that the events imply.
            if (i % 50 == 0)
            {
                std::size_t inside = 0;
                for (const BodyId id : scene.bodies())
                    for (const ShapeId shape : scene.body(id).shapes())
                        if (scene.shape(shape).is_trigger())
                            inside += scene.inside(shape).size();
                std::size_t open = 0;
                for (const auto& [pair, state] : ledger.open)
                    open += static_cast<std::size_t>(state);
                ASSERT_EQ(inside, open);
            }
        }
    }
    for (const BodyId id : scene.bodies())
        scene.destroy(id);
    scene.step(1.0f / 60);
    ledger.read(scene);
    for (const auto& [pair, state] : ledger.open)
        EXPECT_EQ(state, 0) << "trigger " << pair.first.slot << " visitor " << pair.second.slot;
    EXPECT_EQ(ledger.enters, ledger.exits);
    EXPECT_GT(ledger.enters, operations / 20);
}

} // namespace

TEST(Row07_TriggerPairing, UnderTenThousandRandomOperations) { run(1, 10000); }

TEST(Row07_TriggerPairing, UnderManySeeds)
{
    for (std::uint64_t seed = 2; seed < 12; ++seed)
    {
        run(seed, 1500);
        if (HasFailure())
            return;
    }
}
