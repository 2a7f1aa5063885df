#pragma once

// The energy of a small island over a sub-step.

#include "dynamics/solver/joint/joint_bodies.h"

#include <array>
#include <span>

namespace carom::internal {

/// Joints that hold and surfaces that stand still do no work. The energy of bodies that hang or lean together may therefore not rise by more than
/// forces, springs and impacts give, and does not fall either where joints alone hold them: the speeds at which they move against each other
/// are scaled to it. What is left of the error of finite steps is one of phase. Bodies on one that is driven evenly, such as a turning drum, are seen
/// from it: there it does no work, and the Jacobi integral takes the place of the energy, with a potential of -m w^2 r^2 / 2.
class IslandEnergy
{
public:
    static constexpr int most_bodies = most_watched_bodies;

    /// Before the forces of a sub-step.
    void begin(const SolverView& view, const StepContext& ctx, std::span<JointWork> joints, const Island& island);
    /// Around what happens in flight: energy that impacts took or gave stays so; what the solver had put into joints and impacts stopped does not.
    void before_impacts();
    void after_impacts(std::span<const StoppedJoint> stopped);
    /// After the relaxation: joints and contacts that bear something make groups.
    void note_load(std::span<const ContactConstraint> constraints, std::span<const ContactConstraint> late_constraints);
    /// At the end. `exact`: the joints were solved to the end; else they may only have put in too much.
    void restore(bool exact);
    /// It has moved bodies.
    [[nodiscard]] bool has_cut_speeds() const { return m_has_cut_speeds; }

private:
    /// Energies against what stands and against the carrier.
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

    /// Velocity of a frame where the body is.
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
        double mass_x = 0; ///< what is locked has none to speak of: it does not move
        double mass_y = 0;
        double inertia = 0;
        Energy missing{}; ///< what there was and has been added since, less what there is
        Energy first{};   ///< what there was
        Energy work{};    ///< that forces have done since, among them, as the carrier sees it, the one that drives outwards
        Arm center{};     ///< when the step began, seen from the carrier's center then, or from the first body's
        Arm arm{};        ///< seen from it at the start of the sub-step
        Vec2 position{};  ///< at the start of the sub-step
        Rotation rotation{};
        Vec2 position_before_impacts{};
        Rotation rotation_before_impacts{};
        int group = 0;     ///< the least body it is connected with
        bool flew = false; ///< at the start of the sub-step

        [[nodiscard]] double twice_kinetic(const BodyState& s, const Motion& frame) const; ///< as seen there
    };

    /// How bodies move as one: velocity of the common center of mass, axis by axis (a locked axis has none), and the turn about it.
    struct Drift
    {
        double mass_x = 0;
        double mass_y = 0;
        double px = 0;
        double py = 0;
        double x = 0; ///< center of mass, once all are added
        double y = 0;
        double inertia = 0; ///< about it
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
        double push_out = 0;        ///< that contacts have done, for bodies overlapped: it gives them no speed
        double constraint_work = 0; ///< that joints have done, for others moved them
        double slop_work = 0;       ///< of the forces along the slop
        bool touches = false;
        bool is_joined = false;   ///< by joints or contacts
        bool is_anchored = false; ///< to what does not move
        bool is_carried = false;  ///< by the carrier
        bool is_passive = true;   ///< nothing may do work on it but forces and springs
        bool may_lose = false;    ///< contacts, limits, dampers

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
    [[nodiscard]] double inner_energy(int group, const Drift& drift); ///< against the motion of the whole
    void scale(int group, bool exact);
    void cut_speeds(int group, double share);
    void cut_speed(std::int32_t state, float rest, bool is_carried);
    [[nodiscard]] Arm place_of(std::int32_t state);
    [[nodiscard]] Drift drift_of(int group);
    [[nodiscard]] Motion frame_of(const Group& group, const Drift& drift, std::int32_t state);

    SolverView m_view{};
    const SceneState* m_state = nullptr;
    std::span<JointWork> m_joints;
    float m_slop = 0;
    float m_rest_speed = 0;
    int m_subdivisions = 1;
    bool m_all_driven = false; ///< nothing to watch
    bool m_has_cut_speeds = false;
    std::int32_t m_first = 0;
    std::int32_t m_count = 0;
    std::int32_t m_carrier = none; ///< state of the one kinematic body that moves
    BodyState m_carrier_before{};  ///< at the start of the sub-step
    std::array<Body, most_bodies> m_bodies;
    std::array<Group, most_bodies> m_groups;
};

} // namespace carom::internal
