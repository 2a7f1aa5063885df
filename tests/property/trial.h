#pragma once

/// @file
/// A trial: one shot in one small scene, the laws that hold in all of them, and what the arrangement knows by construction.

#include "carom/scene.h"
#include "property/plane.h"
#include "support/test_scene.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace carom::shots {

/// A random number, as shapes and materials take it.
[[nodiscard]] inline float f(double x) { return static_cast<float>(x); }
/// And back.
[[nodiscard]] inline double d(float x) { return static_cast<double>(x); }

using test::Random;

/// The first failure.
struct Failure
{
    std::string
        law{}; ///< "passed", "strayed", "time", "energy", "momentum", "finite", "quarantine", "triggers", "contacts", "refused"
    int step = 0;
    std::string sentence{};
};

/// The frame in which nothing does work on the dynamic bodies: that of the one kinematic body, where there is one. It moves with
/// u and turns with w about the pivot; then E - u P - w L never rises (the Jacobi integral), E alone may.
struct Frame
{
    Point u{};
    double w = 0;
    Point pivot{};
};

class Trial
{
public:
    explicit Trial(std::uint64_t number) : random(number * 0x9e3779b97f4a7c15u + 0x5bd1e995u) {}

    Random random;
    float dt = 1.0f / 60;
    int steps = 10;
    std::ostringstream story; ///< how the arrangement looks, for whoever reads a failure

    /// Makes the scene: its length scale fits things of this size, m.
    Scene& open(double size, Point gravity);
    [[nodiscard]] Scene& scene() { return *m_scene; }
    [[nodiscard]] double slop() const;
    [[nodiscard]] double time() const { return m_time; }

    /// An expectation of the arrangement: called after every step, gives a sentence where something is on the wrong side.
    void expect(std::function<std::string()> holds) { m_expectations.push_back({"passed", std::move(holds)}); }
    void expect(const char* law, std::function<std::string()> holds) { m_expectations.push_back({law, std::move(holds)}); }
    /// The torque acts on the body through every step, N m.
    void drive(BodyId body, float torque) { m_torques.push_back({body, torque}); }
    /// Work that motors and applied torques have done since the start, J, and how much every reading and every step may add to its error.
    void account_work(std::function<double()> work, double resolution)
    {
        m_work = std::move(work);
        m_work_resolution = resolution;
    }
    void energy_in(Frame frame) { m_frame = frame; }
    /// Something does work that the trial cannot account for.
    void skip_energy() { m_check_energy = false; }
    /// Nothing outside acts; where the bodies cannot turn, something holds their angles and angular momentum means nothing.
    void expect_momentum(bool angular)
    {
        m_check_momentum = true;
        m_check_angular = angular;
    }

    /// Steps, checks, and takes the scene apart at the end. A trace prints every step.
    std::optional<Failure> run(bool trace);
    /// Whether anything has met anything: a trial without that has shown nothing.
    [[nodiscard]] bool met() const { return m_met; }
    /// Prints a stand-alone program that plays the same shot through the public API. Call before run.
    void print_program(std::ostream& out);

private:
    struct Sums
    {
        double energy = 0;
        double scale = 0;  // sum of the magnitudes that make the energy, without the potential
        double weight = 0; // sum of m g
        Point momentum{};
        double angular = 0;
        double momentum_scale = 0;
        double angular_scale = 0;
    };
    using Pairs = std::map<std::pair<ShapeId, ShapeId>, std::pair<int, int>>;

    [[nodiscard]] Sums sums();
    [[nodiscard]] double pressed_work(const Sums& now) const;
    void add_body(ConstBody body, Sums& sums) const;
    void add_springs(Sums& sums);
    void print_state(int step);
    [[nodiscard]] std::optional<Failure> step_once(int step);
    [[nodiscard]] std::optional<Failure> check_finite(int step);
    [[nodiscard]] std::optional<Failure> check_energy(int step);
    [[nodiscard]] std::optional<Failure> check_momentum(int step);
    [[nodiscard]] std::optional<Failure> check_pairs(int step);
    [[nodiscard]] std::optional<Failure> check_sides(int step);
    [[nodiscard]] std::optional<Failure> take_apart();

    std::unique_ptr<Scene> m_scene;
    struct Expectation
    {
        const char* law;
        std::function<std::string()> holds;
    };
    std::vector<Expectation> m_expectations;
    std::vector<std::pair<BodyId, float>> m_torques;
    std::function<double()> m_work = [] { return 0.0; };
    double m_work_resolution = 0;
    Frame m_frame{};
    bool m_check_energy = true;
    bool m_check_momentum = false;
    bool m_check_angular = false;
    double m_time = 0;
    bool m_met = false;
    Sums m_start{};
    Sums m_least{}; // at the moment of the least energy so far
    double m_least_net = 0;
    bool m_is_least = true; // after the last step
    double m_pressed = 0;   // J, the most in overlaps since then
    std::map<std::pair<ShapeId, ShapeId>, int> m_inside;
    std::map<std::pair<ShapeId, ShapeId>, int> m_touching;
};

/// Writes numbers as a failure shows them.
template <class... Parts>
[[nodiscard]] std::string say(const Parts&... parts)
{
    std::ostringstream out;
    out.precision(9);
    (out << ... << parts);
    return out.str();
}

std::ostream& operator<<(std::ostream& out, Point p);

} // namespace carom::shots
