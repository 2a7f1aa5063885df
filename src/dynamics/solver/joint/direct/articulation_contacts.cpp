// Contacts of articulations: bodies connected by joints respond to a contact impulse as a whole. A contact that knew only its own body would stop a foot and
// let the joints push it on, pass after pass, and converge as slowly as the foot is lighter than what it carries.
//
//   Y = -A^-1 J M^-1 E,   R = M^-1 (E + J^T Y)       responses of the joints, and of the bodies, to unit impulses E on one body
//   impulse = -(j v + bias) / (j R j^T)
//
// While contacts are solved, only the bodies that have contacts are kept up to date. The other bodies and the joints get their shares at the end.
//
// An articulation that is anchored to an immovable body has no such response everywhere: a wall may contradict its joints, which then have to yield. There,
// and between two bodies of one articulation, contacts act on their own bodies alone, and passes over joints and contacts alternate.

#include "dynamics/solver/joint/direct/direct_solver.h"

#include "core/index.h"
#include "core/union_find.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

// The least share of a body's own response that counts. Below it, joints leave only rounding, as for a rotation that another body's lock forbids.
constexpr double least_answer = 1e-9;

} // namespace

// --- articulations ------------------------------------------------------------------------------------------------------------------------

void DirectSolve::find_articulations()
{
    UnionFind sets;
    sets.reset(m_nodes.size());
    for (const Item& item : m_items)
    {
        if (item.a != JointMatrix::ground && item.b != JointMatrix::ground)
            sets.link(item.a, item.b, false);
    }
    m_articulations.clear();
    m_articulation_of.assign(m_nodes.size(), none);
    for (std::size_t i = JointMatrix::ground + 1; i < m_nodes.size(); ++i)
    {
        const auto first = as_index(sets.root(static_cast<std::int32_t>(i)));
        if (first == i)
        {
            m_articulation_of[i] = static_cast<int>(m_articulations.size());
            m_articulations.emplace_back();
        }
        m_articulation_of[i] = m_articulation_of[first];
        m_articulations[as_index(m_articulation_of[i])].nodes.push_back(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < m_items.size(); ++i)
    {
        const Item& item = m_items[i];
        const int node = item.a != JointMatrix::ground ? item.a : item.b;
        if (node == JointMatrix::ground)
            continue;
        Articulation& articulation = m_articulations[as_index(m_articulation_of[as_index(node)])];
        articulation.items.push_back(static_cast<int>(i));
        for (int r = 0; r < m_edges[i].rows(); ++r)
            articulation.rows.push_back(item.first_row + r);
    }
    for (Articulation& articulation : m_articulations)
        std::ranges::sort(articulation.rows);
}

void DirectSolve::find_anchors()
{
    m_has_free_articulations = false;
    for (Articulation& articulation : m_articulations)
    {
        const auto holds = [&](int i)
        { return m_items[as_index(i)].a == JointMatrix::ground || m_items[as_index(i)].b == JointMatrix::ground; };
        articulation.anchored = std::ranges::any_of(articulation.items, holds) ||
                                std::ranges::any_of(articulation.nodes, [&](int n) { return is_locked(m_nodes[as_index(n)]); });
        m_has_free_articulations |= !articulation.anchored;
    }
}

// None if the body belongs to no articulation that may be pushed as a whole.
int DirectSolve::articulation_of(std::int32_t state, Anchored anchored) const
{
    if (moving(state) == none)
        return none;
    const auto at = as_index(node_of(state));
    if (at >= m_nodes.size() || m_nodes[at].state != state)
        return none;
    const int articulation = m_articulation_of[at];
    return anchored == Anchored::No && m_articulations[as_index(articulation)].anchored ? none : articulation;
}

// --- responses ----------------------------------------------------------------------------------------------------------------------

Triple DirectSolve::Response::to(const Triple& impulse) const { return {dot(x, impulse), dot(y, impulse), dot(turn, impulse)}; }

void DirectSolve::Response::add(const Triple& inverse_mass, const Triple& jacobian, const Triple& answers)
{
    x += (inverse_mass.x * jacobian.x) * answers;
    y += (inverse_mass.y * jacobian.y) * answers;
    turn += (inverse_mass.turn * jacobian.turn) * answers;
}

DirectSolve::Side DirectSolve::side_of(std::int32_t state, Anchored anchored)
{
    const int articulation = articulation_of(state, anchored);
    if (articulation == none)
        return {state};
    const int n = node_of(state);
    int& body = m_pushed_of[as_index(n)];
    if (body == none)
    {
        body = static_cast<int>(m_pushed.size());
        std::vector<int>& others = m_articulations[as_index(articulation)].pushed;
        m_pushed.push_back({.node = n, .articulation = articulation, .place = others.size()});
        others.push_back(body);
    }
    return {state, articulation, body};
}

void DirectSolve::find_responses(PushedBody& body)
{
    const Articulation& whole = m_articulations[as_index(body.articulation)];
    const Triple& mass = m_masses[as_index(body.node)];
    m_answer.resize(as_index(m_matrix.rows()));
    for (const int i : whole.items)
    {
        const Item& item = m_items[as_index(i)];
        const JointJacobian& j = m_jacobians[as_index(i)];
        for (int r = 0; r < item.rows(); ++r)
            m_answer[as_index(item.first_row + r)] = item.a == body.node   ? -1 * product(mass, j.a[r])
                                                     : item.b == body.node ? -1 * product(mass, j.b[r])
                                                                           : Triple{};
    }
    m_matrix.solve(m_answer, whole.rows);
    body.first_answer = m_answers.size();
    for (const int row : whole.rows)
        m_answers.push_back(m_answer[as_index(row)]);

    body.first_response = m_responses.size();
    m_responses.resize(m_responses.size() + whole.pushed.size());
    const auto response_of = [&](int node) -> Response*
    {
        const int at = m_pushed_of[as_index(node)];
        return at == none ? nullptr : &m_responses[body.first_response + m_pushed[as_index(at)].place];
    };
    *response_of(body.node) = {{mass.x, 0, 0}, {0, mass.y, 0}, {0, 0, mass.turn}};
    for (const int i : whole.items)
    {
        const Item& item = m_items[as_index(i)];
        const JointJacobian& j = m_jacobians[as_index(i)];
        Response* a = response_of(item.a);
        Response* b = response_of(item.b);
        for (int r = 0; r < item.rows(); ++r)
        {
            const Triple& answers = m_answer[as_index(item.first_row + r)];
            if (a != nullptr)
                a->add(m_masses[as_index(item.a)], j.a[r], answers);
            if (b != nullptr)
                b->add(m_masses[as_index(item.b)], j.b[r], answers);
        }
    }
    body.responds = true;
}

// The velocity that one body gains by an impulse on the other, or on itself.
Triple DirectSolve::response(const Side& of, const Side& pushed, const Triple& impulse)
{
    if (pushed.body == none)
        return of.state == pushed.state ? response_alone(pushed, impulse) : Triple{};
    PushedBody& body = m_pushed[as_index(pushed.body)];
    if (!body.responds)
        find_responses(body);
    if (of.articulation != pushed.articulation)
        return {};
    return m_responses[body.first_response + m_pushed[as_index(of.body)].place].to(impulse);
}

// The speed along a line per unit impulse along the other.
double DirectSolve::mobility(const Contact& contact, const PushedLine& along, const PushedLine& by)
{
    const auto& [constraint, a, b] = contact;
    return dot(along.ja, response(a, a, by.ja)) + dot(along.ja, response(a, b, by.jb)) + dot(along.jb, response(b, a, by.ja)) +
           dot(along.jb, response(b, b, by.jb));
}

Triple DirectSolve::response_alone(const Side& side, const Triple& impulse) const
{
    const StateConstants& c = m_view.constants[side.state];
    return product(as_triple(c.inverse_mass, c.inverse_inertia), impulse);
}

// The effective mass is 0 where joints leave only rounding of the bodies' own response, as for a rotation that another body's lock forbids.
DirectSolve::PushedLine DirectSolve::pushed_line(const Contact& contact, const Triple& ja, const Triple& jb)
{
    const auto& [constraint, a, b] = contact;
    PushedLine line{a, b, ja, jb};
    const double k = mobility(contact, line, line);
    const double alone = dot(ja, response_alone(a, ja)) + dot(jb, response_alone(b, jb));
    line.mass = k > least_answer * alone ? static_cast<float>(1 / k) : 0;
    return line;
}

void DirectSolve::push_whole(const PushedLine& line, float impulse)
{
    if (impulse == 0 || line.mass == 0)
        return;
    push_whole(line.a, static_cast<double>(impulse) * line.ja);
    push_whole(line.b, static_cast<double>(impulse) * line.jb);
    m_largest_push = std::max(m_largest_push, std::fabs(impulse) / line.mass);
}

void DirectSolve::push_whole(const Side& side, const Triple& impulse)
{
    if (side.body == none)
    {
        change_velocity(m_view.states[side.state], response_alone(side, impulse));
        return;
    }
    PushedBody& body = m_pushed[as_index(side.body)];
    body.given += impulse;
    const Response* response = &m_responses[body.first_response];
    for (const int i : m_articulations[as_index(side.articulation)].pushed)
        change_velocity(m_view.states[node(m_pushed[as_index(i)].node).state], (response++)->to(impulse));
}

// --- passes -------------------------------------------------------------------------------------------------------------------------

void DirectSolve::solve_contacts(std::span<ContactConstraint> constraints, std::span<ContactConstraint> late_constraints,
                                 bool use_bias, float tiny)
{
    constexpr int most_sweeps = 4;
    begin_pushes();
    for (const std::span<ContactConstraint> some : {constraints, late_constraints})
    {
        for (ContactConstraint& constraint : some)
            m_contacts.push_back({&constraint, side_of(constraint.a, Anchored::No), side_of(constraint.b, Anchored::No)});
    }
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
    {
        m_largest_push = 0;
        for (const Contact& contact : m_contacts)
        {
            if (contact.a.articulation == contact.b.articulation) // or both in none
                solve_contact_constraints(m_view, {contact.constraint, 1}, use_bias);
            else
                solve_contact(contact, use_bias);
        }
        if (m_largest_push < tiny)
            break;
    }
    for (const Articulation& articulation : m_articulations)
        take_pushes(articulation);
    take_answers();
}

void DirectSolve::begin_pushes()
{
    for (Articulation& articulation : m_articulations)
        articulation.pushed.clear();
    m_contacts.clear();
    m_pushed.clear();
    m_pushed_of.assign(m_nodes.size(), none);
    m_responses.clear();
    m_answers.clear();
    m_answered.assign(m_impulses.size(), 0);
}

void DirectSolve::solve_contact(const Contact& contact, bool use_bias)
{
    ContactConstraint& constraint = *contact.constraint;
    const auto line = [&](Vec2 d, const ConstraintPoint& p)
    { return pushed_line(contact, as_triple(-d, -cross(p.ra, d)), as_triple(d, cross(p.rb, d))); };
    for (int i = 0; i < constraint.count; ++i)
    {
        ConstraintPoint& p = constraint.points[i];
        const NormalTarget<float> target = normal_target(m_view, constraint, p, use_bias);
        if (p.normal_impulse == 0 && target.speed + target.bias >= 0)
            continue;
        const PushedLine normal = line(constraint.n, p);
        const float updated = normal_impulse(normal.mass, p.normal_impulse, target);
        push_whole(normal, updated - std::exchange(p.normal_impulse, updated));
    }
    const float load = load_of(constraint);
    if (constraint.rolling > 0 && (load > 0 || constraint.rolling_impulse != 0))
    {
        const PushedLine turn = pushed_line(contact, {0, 0, -1}, {0, 0, 1});
        const float slip = m_view.states[constraint.b].angular_velocity - m_view.states[constraint.a].angular_velocity;
        const float updated = friction_impulse(constraint.rolling_impulse, turn.mass, slip, constraint.rolling * load);
        push_whole(turn, updated - std::exchange(constraint.rolling_impulse, updated));
    }
    for (int i = 0; i < constraint.count; ++i)
    {
        ConstraintPoint& p = constraint.points[i];
        const float limit = constraint.friction * p.normal_impulse;
        if (limit == 0 && p.tangent_impulse == 0)
            continue;
        const PushedLine along = line(perp(constraint.n), p);
        const float updated = friction_impulse(p.tangent_impulse, along.mass, constraint_slip(m_view, constraint, p), limit);
        push_whole(along, updated - std::exchange(p.tangent_impulse, updated));
    }
}

// Applies the answers of the joints to all pushes, and the velocity changes of bodies without contacts.
void DirectSolve::take_pushes(const Articulation& articulation)
{
    bool is_pushed = false;
    for (const int p : articulation.pushed)
    {
        const PushedBody& body = m_pushed[as_index(p)];
        if (!body.responds)
            continue;
        is_pushed = true;
        for (std::size_t i = 0; i < articulation.rows.size(); ++i)
            m_answered[as_index(articulation.rows[i])] += dot(m_answers[body.first_answer + i], body.given);
    }
    if (!is_pushed)
        return;
    m_before.clear();
    for (const int n : articulation.nodes)
        m_before.push_back(std::exchange(node(n).change, {}));
    for (const int p : articulation.pushed)
    {
        const PushedBody& body = m_pushed[as_index(p)];
        node(body.node).change += product(m_masses[as_index(body.node)], body.given);
    }
    for (const int i : articulation.items)
    {
        const Item& item = m_items[as_index(i)];
        for (int r = 0; r < item.rows(); ++r)
            push(item, r, m_answered[as_index(item.first_row + r)]);
    }
    for (std::size_t i = 0; i < articulation.nodes.size(); ++i)
    {
        Node& n = node(articulation.nodes[i]);
        if (m_pushed_of[as_index(articulation.nodes[i])] == none)
            change_velocity(m_view.states[n.state], n.change);
        n.change += m_before[i];
    }
}

void DirectSolve::take_answers()
{
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            item.impulse(r) += static_cast<float>(m_answered[as_index(item.first_row + r)]);
    }
    answer_along_axes();
}

void DirectSolve::answer_along_axes()
{
    for (std::size_t i = 0; i < m_impulses.size(); ++i)
        m_impulses[i] += m_answered[i];
    // A motor may have answered with more than its maximum: the next solve takes the excess back.
    for (const Axis& axis : m_axes)
    {
        const double answered = m_answered[as_index(axis.row)];
        if (answered == 0)
            continue;
        AxisImpulses now = axis.law.split(axis.piece, axis.before + m_impulses[as_index(axis.row)], rate_of_law(axis));
        now.motor += axis.before + m_impulses[as_index(axis.row)] - now.sum();
        set_impulses_of(axis, axis.law.scope.merge(axis.restore, now));
    }
}

} // namespace carom::internal
