#pragma once

// The direct solve of an island's joints, an alternative to the sequential impulses of joint_solver.h.

#include "dynamics/solver/joint/direct/joint_matrix.h"
#include "dynamics/solver/joint/joint_axis.h"
#include "dynamics/solver/joint/joint_bodies.h"

#include <span>
#include <vector>

namespace carom::internal {

[[nodiscard]] inline Triple as_triple(Vec2 v, float turn)
{
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(turn)};
}

inline void change_velocity(BodyState& s, const Triple& by)
{
    s.velocity += Vec2{static_cast<float>(by.x), static_cast<float>(by.y)};
    s.angular_velocity += static_cast<float>(by.turn);
}

/// A contact when something bounces: the speeds at which its points are to separate. 0: the point was not struck.
struct ContactBounce
{
    ContactConstraint* constraint = nullptr;
    float wanted[2] = {};
    float stopped[2] = {}; ///< impulses by which they were stopped
    bool answers[2] = {};  ///< whether it is struck or touches: one that is still apart does not answer
};

/// Solves all joint rows of an island at once. It is reused from step to step for its memory, and for the layout where the joints are the same.
class DirectSolve
{
public:
    enum class Masses
    {
        Loaded, ///< bodies that a load stretches get a larger inertia
        Own     ///< where only speeds change: other masses might add energy
    };

    /// Has the constraint graph rebuilt: once per step, and after a body has taken off or landed.
    void look_again() { m_looks_again = true; }
    /// Works at the present pose. The solve is not ready if there are no rows or it is not wanted; the soft rows of joint_solver.h are used then.
    void prepare(const SolverView& view, SceneState& state, std::span<JointWork> joints, Masses masses);
    /// Once per step. Springs that share bodies swing faster together than each alone, and must damp what a sub-step cannot follow.
    void fit_springs();
    /// Otherwise it is never ready.
    void set_wanted(bool wanted) { m_is_wanted = wanted; }
    [[nodiscard]] bool is_ready() const { return m_ready; }
    /// For joints that a wall or other constraints hold open. From here on all joints are as soft as their bodies are heavy, and close no faster than overlap
    /// is pushed out.
    void yield();
    [[nodiscard]] bool yields() const { return m_yields; }
    void warm_start();
    void solve(bool use_bias);
    /// Whether an articulation is free, that is, not anchored to an immovable body. Its contacts are solved here, with the response of the joints;
    /// see articulation_contacts.cpp.
    [[nodiscard]] bool has_free_articulations() const { return m_ready && m_has_free_articulations; }
    [[nodiscard]] bool is_in_free_articulation(std::int32_t state) const
    {
        return m_ready && articulation_of(state, Anchored::No) != none;
    }
    /// A few sweeps over all contacts of the island, right after solve(). They end once no contact changes a speed by more than `tiny`, m/s.
    void solve_contacts(std::span<ContactConstraint> constraints, std::span<ContactConstraint> late_constraints, bool use_bias,
                        float tiny);
    /// Makes struck contacts separate, through the joints. `bounces` are all contacts that may answer; a push that changes a speed by less than `tiny` is left.
    void bounce_contacts(std::span<const ContactBounce> bounces, float tiny);
    /// Removes speeds that joints forbid and that the bodies got outside the solver, before any load is known.
    void take_forbidden_speeds();
    /// Makes joints leave their stops at the speeds JointWork::bounce.
    void bounce();
    /// Whether no straight path leads to where the joints want the bodies. The bodies then drift, and the gaps are closed afterwards.
    [[nodiscard]] bool turns_too_far() const { return m_turns_too_far; }
    /// Moves the bodies by one Newton step and leaves their velocities unchanged.
    void close_gaps();
    /// Makes joints yield where a gap is left that no move closes.
    void yield_to_gaps();

private:
    enum class Stage
    {
        Ahead, ///< errors at the pose that the velocities lead to are 0
        Now,   ///< J v = 0 at the pose reached
        Soft,  ///< the same, while errors close slowly
        Held   ///< J v = 0 for the held rows only
    };

    /// The part of a row that enters J, and so the matrix.
    struct Line
    {
        Vec2 d{};
        float arm_a = 0;
        float arm_b = 0;
        bool is_angle = false;
    };

    struct Edge
    {
        std::size_t joint = 0; ///< index into m_joints
        std::int32_t a = 0;    ///< states; none: immovable
        std::int32_t b = 0;
        int held = 0;
        int axes = 0;

        [[nodiscard]] int rows() const { return held + axes; }
        friend bool operator==(const Edge&, const Edge&) = default;
    };

    /// A joint in the matrix.
    struct Item
    {
        std::size_t joint = 0;
        int held = 0;
        int axes = 0;
        int first_row = 0;
        int a = JointMatrix::ground; ///< nodes
        int b = JointMatrix::ground;
        Line lines[most_joint_rows];
        const JointWork* work = nullptr;
        JointRecord* record = nullptr;

        [[nodiscard]] int rows() const { return held + axes; }
        [[nodiscard]] const JointRow& row(int r) const { return work->rows.row(r); }
        [[nodiscard]] const JointAxis& axis(int r) const { return work->rows.axis[r - held]; }
        [[nodiscard]] int row_of(const JointAxis& axis) const { return held + static_cast<int>(&axis - work->rows.axis); }
        [[nodiscard]] bool take_lines();
        [[nodiscard]] float& impulse(int row) const { return record->impulses[slot_held + row]; } ///< of a held row
    };

    /// A free axis in the equations.
    struct Axis
    {
        std::size_t item = 0;
        const JointAxis* joint_axis = nullptr;
        int row = 0;
        AxisLaw law{};
        AxisPiece piece{};
        double before = 0;      ///< impulse that the law has given already
        AxisImpulses restore{}; ///< impulses before the solve
    };

    /// A body connected by joints. All immovable bodies share one node.
    struct Node
    {
        std::int32_t state = none;
        float stretch = 0; ///< (omega h)²
        float sprung = 0;  ///< omega² that its springs would give it if nothing else moved
        int springs = 0;
        Placement ahead{};
        Triple change{}; ///< change of its velocity
    };

    /// A spring along a line between anchors. Its impulse acts along the mean line over the sub-step rather than along the row, which is that at the start.
    struct SprungLine
    {
        std::size_t item = 0;
        Triple on_a{}; ///< impulses that turn the spring's impulse from the row into the mean line
        Triple on_b{};
    };

    /// Bodies connected by joints.
    struct Articulation
    {
        std::vector<int> nodes;
        std::vector<int> items;
        std::vector<int> rows;   ///< rows of the matrix, in order
        bool anchored = false;   ///< connected to an immovable body
        std::vector<int> pushed; ///< bodies that have contacts
    };

    /// The velocity that a body gains per unit impulse on one body of its articulation, by component.
    struct Response
    {
        Triple x{};
        Triple y{};
        Triple turn{};

        [[nodiscard]] Triple to(const Triple& impulse) const;
        /// Adds the share of a joint's row: the row's answers to the unit impulses act on the body along the Jacobian.
        void add(const Triple& inverse_mass, const Triple& jacobian, const Triple& answers);
    };

    /// A body of an articulation that has contacts.
    struct PushedBody
    {
        int node = 0;
        int articulation = 0;
        std::size_t place = 0;          ///< index among the pushed bodies of the articulation
        bool responds = false;          ///< whether responses and answers to unit impulses on it are known
        std::size_t first_response = 0; ///< the first of them, in the order of the articulation's pushed bodies
        std::size_t first_answer = 0;   ///< the first of the joints' answers, in the order of the articulation's rows
        Triple given{};                 ///< impulse, by all contacts so far
    };

    /// A body of a contact: as a part of its articulation, or on its own.
    struct Side
    {
        std::int32_t state = none;
        int articulation = none;
        int body = none; ///< index of the pushed body
    };

    struct Contact
    {
        ContactConstraint* constraint = nullptr;
        Side a;
        Side b;
    };

    struct PushedLine
    {
        Side a;
        Side b;
        Triple ja{};
        Triple jb{};
        float mass = 0; ///< effective mass
    };

    void find_articulations();
    void find_anchors();
    enum class Anchored
    {
        No, ///< articulations that hang on an immovable body do not count
        Too
    };
    [[nodiscard]] int articulation_of(std::int32_t state, Anchored anchored) const;
    void find_responses(PushedBody& body);
    [[nodiscard]] Side side_of(std::int32_t state, Anchored anchored);
    [[nodiscard]] Triple response(const Side& of, const Side& pushed, const Triple& impulse);
    [[nodiscard]] double mobility(const Contact& contact, const PushedLine& along, const PushedLine& by);
    [[nodiscard]] Triple response_alone(const Side& side, const Triple& impulse) const;
    [[nodiscard]] PushedLine pushed_line(const Contact& contact, const Triple& ja, const Triple& jb);
    void begin_pushes();
    void push_whole(const PushedLine& line, float impulse);
    void push_whole(const Side& side, const Triple& impulse);
    void solve_contact(const Contact& contact, bool use_bias);
    void take_pushes(const Articulation& articulation);
    void take_answers();
    void answer_along_axes();
    void bounce_contact(const Contact& contact, const ContactBounce& bounce);
    void report_answers();

    void find_edges();
    [[nodiscard]] std::int32_t moving(std::int32_t state) const;
    [[nodiscard]] int node_of(std::int32_t state) const;
    void lay_out();
    [[nodiscard]] bool place();
    void fill_jacobian(const Item& item, JointJacobian& jacobian) const;
    void note_stretch(const Item& item);
    [[nodiscard]] bool is_locked(const Node& node) const;
    [[nodiscard]] Triple inverse_mass(const Node& node) const;
    void add_spring(Node& node, float stiffness, Vec2 d, float arm) const;
    [[nodiscard]] Node& node(int i) { return m_nodes[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Node& node(int i) const { return m_nodes[static_cast<std::size_t>(i)]; }

    [[nodiscard]] double present_compliance() const;
    [[nodiscard]] bool find_pose_ahead();
    [[nodiscard]] bool may_soften() const;
    void soften_to(double error);
    void soften();
    void note_speeds();
    void note_errors_ahead();
    void place_ahead();
    void turn_springs();
    void straighten_springs();
    void set_turn(SprungLine& line, const Triple& on_a, const Triple& on_b);
    void find_sprung_lines();
    [[nodiscard]] Placement ahead_of(int node, std::int32_t state) const;
    [[nodiscard]] double present_error() const;
    [[nodiscard]] double largest_error() const;
    [[nodiscard]] double largest_gap() const;
    [[nodiscard]] double spring_change() const;
    [[nodiscard]] double largest_turn() const;
    void start_anew();
    [[nodiscard]] float most_speed(const JointRow& row) const;
    void limit_speeds();
    void close_slowly();
    [[nodiscard]] double rate_of_law(const Axis& axis) const;
    [[nodiscard]] double softness(const Axis& axis) const
    {
        return m_yields ? m_leak * m_matrix.weight(axis.row) : 0;
    } // rate per impulse
    [[nodiscard]] AxisActs acts_ahead(const JointAxis& axis, Stage stage) const;

    void take_step(Stage stage);
    void give_blow(Stage stage);
    void find_impulses(Stage stage);
    void begin_axes(Stage stage);
    void begin_axis(Axis& axis, Stage stage);
    void solve_pieces();
    void give_known_impulses();
    [[nodiscard]] bool take_next_pieces(bool all);
    void give_up_on_pieces();
    void push(const Item& item, int row, double impulse);
    void push(const Axis& axis, double impulse);
    [[nodiscard]] double change_along(const Item& item, int row) const;
    [[nodiscard]] double change_along(const Axis& axis) const;
    [[nodiscard]] AxisImpulses impulses_of(const Axis& axis) const
    {
        return axis_impulses(*m_items[axis.item].record, axis.joint_axis->number);
    }
    void set_impulses_of(const Axis& axis, const AxisImpulses& to)
    {
        set_axis_impulses(*m_items[axis.item].record, axis.joint_axis->number, to);
    }
    void take_velocities(double sign = 1);
    void take_impulses();
    void take_back();
    void go_on_from_here();
    void report_as_blow();

    SolverView m_view{};
    SceneState* m_state = nullptr;
    std::span<JointWork> m_joints;
    bool m_looks_again = true;
    bool m_fits = false;                             ///< whether there are rows to solve, and it is wanted
    static constexpr double loop_compliance = 1e-3;  ///< relative to a row's weight, where joints contradict each other
    static constexpr double least_softening = 0.02;  ///< factor of it where they agree
    static constexpr double softening_of_error = 70; ///< per arm or rad that joints are apart

    bool m_is_wanted = true;
    bool m_ready = false;
    bool m_may_contradict = false; ///< whether rows may be redundant: those of loops and of locked bodies
    Masses m_mass_kind = Masses::Own;
    bool m_turns_too_far = false;
    bool m_yields = false;
    float m_longest_arm = 0;

    std::vector<Edge> m_found;
    std::vector<Edge> m_edges; ///< constraint graph of the layout
    JointMatrix m_matrix;
    bool m_is_new = false;   ///< whether the layout is new and the matrix still empty
    double m_compliance = 0; ///< compliance of loops and of yielding joints, in the present stage
    double m_leak = 0;
    double m_softening = 1;       ///< factor of the compliance of loops
    double m_least_softening = 1; ///< that of the errors that this sub-step has seen
    double m_spring_softening = 1;
    double m_spring_change = 0;        ///< greatest speed along a sprung line that the last Newton step has changed
    double m_factored_with = -1;       ///< compliance in the factor; m_compliances are in it as well
    std::vector<double> m_compliances; ///< by row, like the next three
    std::vector<double> m_wanted_compliances;
    std::vector<double> m_speeds; ///< or errors ahead per sub-step
    std::vector<double> m_impulses;

    std::vector<Articulation> m_articulations;
    std::vector<int> m_articulation_of; ///< by node
    bool m_has_free_articulations = false;
    std::vector<Contact> m_contacts;
    std::vector<PushedBody> m_pushed;
    std::vector<int> m_pushed_of; ///< by node
    std::vector<Response> m_responses;
    std::vector<Triple> m_answers;
    std::vector<Triple> m_answer;   ///< answers to unit impulses on one body, by row
    std::vector<double> m_answered; ///< answers to all contacts so far, by row
    std::vector<Triple> m_before;   ///< velocity changes in an articulation
    float m_largest_push = 0;       ///< greatest change of a speed

    std::vector<Item> m_items;
    std::vector<Axis> m_axes; ///< in the present stage
    std::vector<SprungLine> m_sprung_lines;
    std::vector<JointJacobian> m_jacobians;
    std::vector<Node> m_nodes;
    std::vector<Triple> m_masses; ///< inverse masses
};

/// Closes the gaps in four Newton steps, and makes joints yield where a gap remains.
void close_gaps(DirectSolve& direct, const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
