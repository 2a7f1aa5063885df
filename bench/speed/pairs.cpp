#include "speed/pairs.h"

#include "speed/plan.h"

#include <algorithm>
#include <set>

namespace speed {
namespace {

using truth::Vec;

/// A shape, or a piece of a ring, where its body is now.
struct Piece
{
    truth::Hull hull;
    truth::Filter filter;
    std::size_t body;
    bool moves;
    Vec lower{};
    Vec upper{};
};

bool may_touch(const truth::Filter& a, const truth::Filter& b)
{
    if (a.group != 0 && a.group == b.group)
        return false;
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

void set_bounds(Piece& piece, double margin)
{
    piece.lower = piece.upper = piece.hull.corners.front();
    for (const Vec v : piece.hull.corners)
    {
        piece.lower = {std::min(piece.lower.x, v.x), std::min(piece.lower.y, v.y)};
        piece.upper = {std::max(piece.upper.x, v.x), std::max(piece.upper.y, v.y)};
    }
    const double grow = piece.hull.radius + margin / 2;
    piece.lower = piece.lower - Vec{grow, grow};
    piece.upper = piece.upper + Vec{grow, grow};
}

std::vector<Piece> pieces_of(carom::Scene& scene, const std::vector<truth::State>& states, double margin)
{
    std::vector<Piece> pieces;
    const std::vector<carom::BodyId> bodies = scene.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const BodyPlan plan = plan_body(scene.body(bodies[i]), scene);
        const bool moves = plan.def.motion == truth::Motion::Dynamic;
        const auto add = [&](const truth::Shape& shape, const truth::Filter& filter)
        {
            pieces.push_back({truth::hull({shape, states[i].position, states[i].angle}), filter, i, moves});
            set_bounds(pieces.back(), margin);
        };
        for (const auto& [shape, material] : plan.shapes)
            add(shape, material.filter);
        for (const auto& [corners, material] : plan.rings)
            for (std::size_t k = 0; k < corners.size(); ++k)
                add(truth::Segment{corners[k], corners[(k + 1) % corners.size()]}, material.filter);
    }
    return pieces;
}

/// Pairs of bodies, by their places in scene.bodies(), that a joint keeps from touching.
std::set<std::pair<std::size_t, std::size_t>> jointed(carom::Scene& scene)
{
    std::map<carom::BodyId, std::size_t> place;
    for (const carom::BodyId id : scene.bodies())
        place.emplace(id, place.size());
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const carom::JointId id : scene.joints())
    {
        const carom::ConstJoint joint = scene.joint(id);
        if (joint.body_a() && joint.body_b())
            pairs.insert(std::minmax(place.at(joint.body_a()), place.at(joint.body_b())));
    }
    return pairs;
}

bool boxes_meet(const Piece& a, const Piece& b) { return a.lower.y <= b.upper.y && b.lower.y <= a.upper.y; }

} // namespace

// Sort and sweep along x: what is open when a piece begins may be near it.
void for_near_pairs(carom::Scene& scene, const std::vector<truth::State>& states, double margin,
                    const std::function<void(double overlap)>& found)
{
    std::vector<Piece> pieces = pieces_of(scene, states, margin);
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.lower.x < b.lower.x; });
    const auto joints = jointed(scene);
    std::vector<const Piece*> open;
    for (const Piece& piece : pieces)
    {
        std::erase_if(open, [&](const Piece* other) { return other->upper.x < piece.lower.x; });
        for (const Piece* other : open)
        {
            if (piece.body == other->body || !(piece.moves || other->moves) || !boxes_meet(piece, *other) ||
                !may_touch(piece.filter, other->filter) || joints.contains(std::minmax(piece.body, other->body)))
                continue;
            const double depth = truth::overlap(piece.hull, other->hull);
            if (depth > -margin)
                found(depth);
        }
        open.push_back(&piece);
    }
}

} // namespace speed
