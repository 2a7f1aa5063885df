#pragma once

// The energy of a small island over a sub-step.

#include "dynamics/solver/joint/joint_bodies.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace carom::internal {

/// Joints that hold and surfaces that stand still do no work. The energy of bodies that hang or lean together may therefore not rise by more than forces,
/// springs and impacts give. Where joints alone hold the bodies, it does not fall either. The speeds at which they move against each other are scaled to that
/// energy, which leaves a phase error as the only error of finite steps. Bodies on a carrier, a body that is driven evenly such as a turning drum, are seen
/// from its frame. There it does no work, and the Jacobi integral takes the place of the energy, with a potential of -m w^2 r^2 / 2.
class IslandEnergy
{
public:
    /// Called before the forces of a sub-step.
    void begin(const SolverView& view, const StepContext& ctx, std::span<JointWork> joints, const Island& island);
    /// Called around flight. Energy that impacts take or give stays so; the energy of a closing joint that an impact stopped is given back.
    void before_impacts();
    void after_impacts(std::span<const StoppedJoint> stopped);
    /// Called after the relaxation: joints and contacts that bear a load connect bodies into groups.
    void note_load(std::span<const ContactConstraint> constraints, std::span<const ContactConstraint> late_constraints);
    /// Called at the end. `exact`: the joints were solved exactly; otherwise they may only have added too much energy.
    void restore(bool exact);
    /// True if restore() has moved bodies.
    [[nodiscard]] bool has_cut_speeds() const { return m_has_cut_speeds; }

private:
    /// Energies in the world's frame and in the carrier's.
    struct Energy
    {
        double standing = 0;
        double carried = 0;

        Energy& operator+=(const Energy& other)
        {
            standing += other.standing;
            carried += other.carried;
            return *this;
        }
    };

    /// Velocity of a frame at the position of a body.
    struct Motion
    {
        double x = 0;
        double y = 0;
        double w = 0;
    };

    struct Arm
    {
        double x = 0;
        double y = 0;
    };

    struct Body
    {
        double mass_x = 0; ///< 0 along a locked axis, where the body does not move
        double mass_y = 0;
        double inertia = 0;
        Energy missing{}; ///< the first energy and what has been added since, less the present energy
        Energy first{};   ///< energy at the start of the sub-step
        Energy work{};    ///< work of forces since then, in the carrier's frame that of the centrifugal force as well
        Arm center{};     ///< when the step began, relative to the carrier's center then, or to the first body's
        Arm arm{};        ///< relative to the carrier's center at the start of the sub-step
        Vec2 position{};  ///< at the start of the sub-step
        Rotation rotation{};
        Vec2 position_before_impacts{};
        Rotation rotation_before_impacts{};
        int group = 0;             ///< the lowest index of a body that it is connected with
        bool flew = false;         ///< at the start of the sub-step
        bool is_displaced = false; ///< by an impact in this sub-step, while its springs' impulses were those of the drift
        bool is_driven = false;    ///< a joint that may do work moves it

        [[nodiscard]] double twice_kinetic(const BodyState& s, const Motion& frame) const; ///< in that frame
    };

    /// Motion of bodies as a whole: velocity of the common center of mass, axis by axis (a locked axis has none), and rotation about it.
    struct Drift
    {
        double mass_x = 0;
        double mass_y = 0;
        double px = 0;
        double py = 0;
        double x = 0; ///< center of mass, after center()
        double y = 0;
        double inertia = 0; ///< about the center of mass
        double spin = 0;    ///< angular momentum about it

        void add(const Body& body, const BodyState& s, const Arm& at);
        void add_spin(const Body& body, const BodyState& s, const Arm& at);
        void center();
        [[nodiscard]] double vx() const { return mass_x > 0 ? px / mass_x : 0; }
        [[nodiscard]] double vy() const { return mass_y > 0 ? py / mass_y : 0; }
        [[nodiscard]] double w() const { return inertia > 0 ? spin / inertia : 0; }
    };

    struct Group
    {
        Energy missing{};
        Energy first{};
        Energy work{};
        double push_out = 0;        ///< work of contacts that push overlapping bodies apart: it gives them no speed
        double constraint_work = 0; ///< work of joints while they correct errors that other constraints caused
        double slop_work = 0;       ///< work of the forces over a displacement by the slop
        bool touches = false;
        bool is_joined =
            false; ///< by held joints or contacts; springs between bodies that drift freely keep their energy by themselves
        bool is_anchored = false; ///< by something that does not move
        bool is_carried = false;  ///< by the carrier
        bool is_passive = true;   ///< only forces and springs may do work on it
        bool may_lose = false;    ///< to contacts, limits or dampers

        [[nodiscard]] double of(const Energy& energy) const { return is_carried ? energy.carried : energy.standing; }
    };

    [[nodiscard]] bool is_ours(std::int32_t state) const { return state >= m_first && state < m_first + m_count; }
    [[nodiscard]] Body& body(std::int32_t state) { return m_bodies[static_cast<std::size_t>(state - m_first)]; }
    [[nodiscard]] Group& group_of(std::int32_t state) { return m_groups[static_cast<std::size_t>(body(state).group)]; }
    [[nodiscard]] bool flies(std::int32_t state) const { return (m_view.states[state].flags & body_flag::flier) != 0; }
    [[nodiscard]] bool all_driven();
    void find_carrier(const StepContext& ctx, const Island& island);
    [[nodiscard]] bool has_carrier() const { return m_carrier != none; }
    void place_body(const StepContext& ctx, std::int32_t state);
    [[nodiscard]] Arm arm_of(std::int32_t state);
    [[nodiscard]] Motion carried_motion(const Arm& arm) const;
    [[nodiscard]] Energy energy_of(std::int32_t state);
    [[nodiscard]] Energy work_on(std::int32_t state);
    [[nodiscard]] double driven_outwards(const Body& body, const Arm& arm) const;
    void connect(std::int32_t a, std::int32_t b);
    void join(std::int32_t own, std::int32_t other);
    void note_joint(JointWork& work);
    void connect_constraints(std::span<const ContactConstraint> constraints);
    void note_constraints(std::span<const ContactConstraint> constraints);
    void note_constraint(const ContactConstraint& constraint);
    [[nodiscard]] double push_out_of(const ContactConstraint& constraint) const;
    [[nodiscard]] double take_work(JointWork& work) const;
    void add_kinetic(double sign);
    void add_work();
    [[nodiscard]] double force_on(std::int32_t state);
    void add_springs(double sign);
    [[nodiscard]] double inner_energy(int group, const Drift& drift); ///< relative to the motion of the whole
    void scale(int group, bool exact);
    void cut_speeds(int group, double share);
    void cut_speed(std::int32_t state, float rest, bool is_carried);
    [[nodiscard]] Arm place_of(std::int32_t state);
    void make_room(std::size_t count);
    [[nodiscard]] Drift drift_of(int group);
    [[nodiscard]] Motion frame_of(const Group& group, const Drift& drift, std::int32_t state);

    SolverView m_view{};
    const SceneState* m_state = nullptr;
    std::span<JointWork> m_joints;
    float m_slop = 0;
    float m_rest_speed = 0;
    int m_subdivisions = 1;
    bool m_all_driven = false; ///< every body is on a joint that may do work: there is nothing to watch
    bool m_has_cut_speeds = false;
    std::int32_t m_first = 0;
    std::int32_t m_count = 0;
    std::int32_t m_carrier = none;         ///< state of the only kinematic body that moves
    BodyState m_carrier_before{};          ///< at the start of the sub-step
    static constexpr std::size_t few = 64; ///< more bodies are stored on the heap
    std::array<Body, few> m_few_bodies;
    std::array<Group, few> m_few_groups;
    std::vector<Body> m_many_bodies;
    std::vector<Group> m_many_groups;
    std::span<Body> m_bodies;
    std::span<Group> m_groups;
};

} // namespace carom::internal
