#pragma once

// All contacts that touch at one moment and are connected through bodies in flight.

#include "collision/time_of_impact.h"
#include "dynamics/continuous/impact/reflect.h"
#include "dynamics/continuous/motion.h"
#include "dynamics/solver/joint/joint_rows.h"

#include <vector>

namespace carom::internal {

/// Fraction of the size: resting contacts and contacts of solver-owned bodies touch with an overlap or gap up to this.
inline constexpr double still_rests = 1e-3;

class ImpactSet
{
public:
    ImpactSet(const FlightSpan& span, Flier& first);
    void run(std::vector<std::int32_t>& changed);

private:
    struct Member
    {
        int body = none; ///< none: the world, as the other side of a limit
        std::int32_t state = none;
        Flier* flier = nullptr;
        FramePath path{};
        ImpactBody before{};
        bool changed = false;
        bool is_struck = false;   ///< or held by one that is
        bool is_held = false;     ///< its limits and joints have rows
        bool is_expanded = false; ///< and so has everything that touches it
    };

    /// Origin of a row; without shapes: a joint, or a limit of a hinge.
    struct Source
    {
        std::int32_t own = none; ///< on body b of the row
        std::int32_t other = none;
        std::int32_t contact = none;
        std::int32_t joint = none;
        Touch touch{};
        bool kicked = false;
        bool rests = false; ///< its bounce counts as none
        bool bounces = false;
    };

    // Gathering: impact_gather.cpp
    void gather();
    void grow();
    [[nodiscard]] bool has_changed(std::size_t member) const;
    [[nodiscard]] bool leaves_it_to_the_solver(const Member& m) const;
    [[nodiscard]] std::int32_t contact_between(std::int32_t own, std::int32_t other) const;
    int member_of(int body);
    void look_again(RestingContact h);
    void set_masses(const Member& m, ImpactBody& b) const;
    void hold(int index);
    void expand(int index);
    void add_joints(int body);
    [[nodiscard]] JointPose pose_of_joint(const JointRecord& joint, int a, int b) const;
    [[nodiscard]] bool is_known(int contact) const;
    void add_touches(int member, std::int32_t own, std::int32_t other, std::int32_t contact);
    [[nodiscard]] double nearness(int member, std::int32_t own, std::int32_t other, int other_body) const;
    [[nodiscard]] bool was_resting(std::int32_t own, std::int32_t other) const;
    [[nodiscard]] ImpactRow row_of(const Touch& t, int a, int b) const;
    void add_limits(int index);
    void add_limit(int index, double turn);

    // Impulses, and their effect on the bodies: impact.cpp
    void stop_until_next();
    Bounce law(int index, double u);
    [[nodiscard]] double hop_speed(const Source& s, double resting_forces) const;
    [[nodiscard]] double last_bounces(const ImpactRow& row, double resting_forces, double restitution) const;
    [[nodiscard]] bool is_small_blow(const ImpactRow& row, const Source& s, double u) const;
    [[nodiscard]] double size_of(const Source& s) const;
    [[nodiscard]] double blow_of(const Source& s, double acceleration) const;
    [[nodiscard]] double steady_press(const ImpactRow& row) const;
    [[nodiscard]] bool is_crowded(const ImpactRow& row) const;
    double kick(Source& s, float speed);
    [[nodiscard]] double slide_of(const ImpactRow& row) const;
    void note_stopped_joints();
    void write_back(std::size_t i, std::vector<std::int32_t>& changed);
    [[nodiscard]] bool leaves_bouncing(std::size_t member) const;
    [[nodiscard]] Flier* could_fly(const Member& m) const;
    void deflect(Flier& f, const ImpactBody& now, bool struck) const;
    void defer(int index) const;

    // The last resort in a jam: impact_jam.cpp
    class Jam;
    [[nodiscard]] bool unite_jammed();

    // Events for the user: impact_report.cpp
    /// An impact at one contact, or at both contacts of two flat faces.
    struct Strike
    {
        Blow blow{};
        ImpactRow row{};
        double x = 0; ///< where it acts
        double y = 0;
    };
    void report_touch(std::size_t i);
    void report_blows();
    [[nodiscard]] Strike strike_of(const Blow& blow) const;
    [[nodiscard]] bool are_one(const Blow& first, const Blow& second) const;
    void sum_impulse(const ImpactRow& r);
    [[nodiscard]] bool is_worth_reporting(const Blow& blow) const;
    [[nodiscard]] bool own_is_a(const Source& s) const;
    [[nodiscard]] ImpactEvent event_of(const Strike& strike) const;

    // Resting contacts: impact_rest.cpp
    void let_rest_what_presses(std::vector<std::int32_t>& changed);
    [[nodiscard]] bool has_stopped(std::size_t i);
    [[nodiscard]] bool both_have_finite_mass(const ImpactRow& row) const;
    void rest_on_each_other(const ImpactRow& row, const Source& s);
    void accelerate(Member& m, const ImpactBody& a, std::vector<std::int32_t>& changed) const;
    [[nodiscard]] double slip_acceleration(std::size_t i) const;
    [[nodiscard]] double gap_acceleration(std::size_t i);
    void resting_contact(const RestingForce& p);
    void add_resting_contact(Flier& f, const RestingContact& h) const;
    void set_resting_time(std::size_t i);

    const FlightSpan& m_span;
    SceneState& m_state;
    Flier& m_first;
    bool m_renewed; ///< the event renews a resting contact; nothing strikes
    double m_time;
    Position m_origin;
    std::vector<RestingContact> m_released{};
    std::size_t m_looked_at = 0;     ///< of the released ones
    std::vector<Member> m_members{}; ///< parallel to m_bodies
    std::vector<ImpactBody> m_bodies{};
    std::vector<ImpactBody> m_resting{}; ///< accelerations by the resting contacts that were released
    std::vector<Source> m_sources{};     ///< parallel to m_rows
    std::vector<ImpactRow> m_rows{};
    std::vector<Blow> m_blows{};
};

} // namespace carom::internal
