#pragma once

/// @file
/// One scene, built and stepped by one engine.

#include "scenes/scenes.h"
#include "truth/world.h"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace speed {

/// Milliseconds by stage of the step, in the order of stage_names.
inline constexpr std::array stage_names{"sweep", "pairs", "contacts", "islands", "solve", "commit", "events"};
using Stages = std::array<double, stage_names.size()>;
[[nodiscard]] Stages stages_of(const carom::StageTimes& ms);
void add(Stages& sum, const Stages& more);

class Contestant
{
public:
    virtual ~Contestant() = default;
    /// Work for a step that is not the engine's: not timed.
    virtual void prepare(float) {}
    /// The timed part: what the scene's schedule changes before the step, and the step.
    virtual void step(float h) = 0;

    /// Bodies, shapes and joints as they are now. Where the bodies are, states() says.
    [[nodiscard]] virtual carom::Scene& scene() = 0;
    /// In the order of scene().bodies().
    [[nodiscard]] virtual std::vector<truth::State> states() = 0;
    /// Pairs of shapes that the engine keeps as contacts, as it counts them itself.
    [[nodiscard]] virtual int contacts() = 0;
    /// Equal where the engine's state is equal.
    [[nodiscard]] virtual std::uint64_t hash() = 0;
    /// Times of the last step; zeros where the engine does not report them.
    [[nodiscard]] virtual Stages stages() const { return {}; }
    /// Memory that the engine holds on the heap for this scene.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Makes the scene that an engine is to run.
using SceneMaker = std::function<carom::scenes::BuiltScene(const carom::SceneDef&)>;

/// An engine that can be asked to run a scene.
struct Contender
{
    std::string key{};  ///< for the command line and results
    std::string name{}; ///< with its version
    std::string isa{};  ///< what it was compiled for
    int most_threads = 1;
    std::function<std::unique_ptr<Contestant>(const SceneMaker&, const carom::SceneDef&)> enter{};
};

/// Carom first, then the peers that were found when this was built.
[[nodiscard]] std::vector<Contender> contenders();

[[nodiscard]] std::unique_ptr<Contestant> enter_carom(const SceneMaker& build, const carom::SceneDef& def);
[[nodiscard]] std::unique_ptr<Contestant> enter_peer(const truth::Engine& engine, const SceneMaker& build,
                                                     const carom::SceneDef& def);

} // namespace speed
