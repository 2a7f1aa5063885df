/// @file
/// Places where a ball can come to rest and nothing moves it on.
///
/// A ball on an incline rests where two surfaces hold it from both sides, or on a level piece of one. All such places
/// are crossings of the lines on which its centre rolls: each surface pushed out by the ball's radius.

#include "pinball/table/check_context.h"

#include <algorithm>

namespace carom::pinball {
namespace {

constexpr double tolerance = 1e-6;    ///< m
constexpr double level_slope = 0.005; ///< a piece less inclined than this does not move a ball on

/// One line or circle on which the centre of a ball rolls along a curve.
struct Track
{
    const Obstacle* obstacle = nullptr;
    const Curve* curve = nullptr;
    bool is_circle = false;
    Point a{}; ///< of a line
    Point b{};
    Point center{}; ///< of a circle
    double radius = 0;
};

struct Support
{
    Index element = none;
    Point normal{};
};

void add_circle(std::vector<Track>& tracks, const Obstacle& obstacle, const Curve& curve, Point center, double radius)
{
    if (radius > 0)
        tracks.push_back({.obstacle = &obstacle, .curve = &curve, .is_circle = true, .center = center, .radius = radius});
}

void add_tracks(std::vector<Track>& tracks, const Obstacle& obstacle, const Curve& curve, double ball)
{
    const double off = ball + curve.thickness;
    add_circle(tracks, obstacle, curve, curve.a, off);
    if (length(curve.a - curve.b) > 0)
        add_circle(tracks, obstacle, curve, curve.b, off);
    if (curve.is_arc)
    {
        add_circle(tracks, obstacle, curve, curve.center, curve.radius + off);
        add_circle(tracks, obstacle, curve, curve.center, curve.radius - off);
    }
    else if (length(curve.a - curve.b) > 0)
    {
        const Point side = off * perp(unit(curve.b - curve.a));
        tracks.push_back({.obstacle = &obstacle, .curve = &curve, .a = curve.a + side, .b = curve.b + side});
        tracks.push_back({.obstacle = &obstacle, .curve = &curve, .a = curve.a - side, .b = curve.b - side});
    }
}

void add_line_line(const Track& a, const Track& b, std::vector<Point>& points)
{
    const double turn = cross(a.b - a.a, b.b - b.a);
    if (std::abs(turn) > 1e-12)
        points.push_back(a.a + (cross(b.a - a.a, b.b - b.a) / turn) * (a.b - a.a));
}

void add_line_circle(const Track& line, const Track& circle, std::vector<Point>& points)
{
    const Point along = unit(line.b - line.a);
    const double foot = dot(circle.center - line.a, along);
    const double height = cross(along, circle.center - line.a);
    const double root = circle.radius * circle.radius - height * height;
    if (root < 0)
        return;
    points.push_back(line.a + (foot - std::sqrt(root)) * along);
    points.push_back(line.a + (foot + std::sqrt(root)) * along);
}

void add_circle_circle(const Track& a, const Track& b, std::vector<Point>& points)
{
    const double d = length(b.center - a.center);
    if (d < 1e-9)
        return;
    const Point along = (1 / d) * (b.center - a.center);
    const double foot = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
    const double root = a.radius * a.radius - foot * foot;
    if (root < 0)
        return;
    points.push_back(a.center + foot * along + std::sqrt(root) * perp(along));
    points.push_back(a.center + foot * along - std::sqrt(root) * perp(along));
}

std::vector<Point> crossings(const Track& a, const Track& b)
{
    std::vector<Point> points;
    if (a.is_circle && b.is_circle)
        add_circle_circle(a, b, points);
    else if (a.is_circle)
        add_line_circle(b, a, points);
    else if (b.is_circle)
        add_line_circle(a, b, points);
    else
        add_line_line(a, b, points);
    return points;
}

bool supports(const Element& element, Point normal)
{
    // A gate gives way to a ball that presses along its open direction.
    const Gate* gate = std::get_if<Gate>(&element.part);
    return gate == nullptr || dot(normal, gate->open_dir) > 0;
}

/// Whether one of the parts that hold the ball can throw it out again.
bool moves_on(const Element& element)
{
    return std::holds_alternative<Flipper>(element.part) || std::holds_alternative<Plunger>(element.part);
}

/// Not by a kicker: it fires once, and only while it is lit.
bool is_taken_away(const CheckContext& context, Point p)
{
    return std::any_of(context.table.elements.begin(), context.table.elements.end(),
                       [&](const Element& element)
                       {
                           const Sensor* sensor = std::get_if<Sensor>(&element.part);
                           const Saucer* saucer = std::get_if<Saucer>(&element.part);
                           return (sensor != nullptr && sensor->kills && touches(*sensor, p, context.ball_radius)) ||
                                  (saucer != nullptr && length(p - saucer->pos) < saucer->radius);
                       });
}

/// Searches one state of the table: drop targets up, or down.
class RestSearch
{
public:
    RestSearch(CheckContext& context, bool targets_up, std::vector<Point>& found)
        : m_context(context), m_targets_up(targets_up), m_found(found)
    {
        for (const Obstacle& obstacle : context.obstacles)
            if (targets_up || part_of<DropTarget>(context.table, obstacle.element) == nullptr)
                for (const Curve& curve : obstacle.curves)
                {
                    m_curves.push_back({&obstacle, &curve});
                    add_tracks(m_tracks, obstacle, curve, context.ball_radius);
                }
    }
    void run();

private:
    struct OwnedCurve
    {
        const Obstacle* obstacle;
        const Curve* curve;
    };

    [[nodiscard]] bool is_free(Point p) const;
    [[nodiscard]] std::vector<Support> supports_at(Point p) const;
    [[nodiscard]] bool is_held(const std::vector<Support>& supports) const;
    [[nodiscard]] bool is_reached(Point p, const std::vector<Support>& supports) const;
    [[nodiscard]] bool close_enough(const Track& a, const Track& b) const;
    bool consider(Point p);
    void consider_level_piece(const Track& track);

    CheckContext& m_context;
    bool m_targets_up;
    std::vector<OwnedCurve> m_curves{};
    std::vector<Track> m_tracks{};
    std::vector<Point>& m_found; ///< of both states: a place is reported once
};

bool RestSearch::is_free(Point p) const
{
    return std::all_of(m_curves.begin(), m_curves.end(),
                       [&](const OwnedCurve& owned) { return distance(*owned.curve, p) > m_context.ball_radius - tolerance; });
}

std::vector<Support> RestSearch::supports_at(Point p) const
{
    std::vector<Support> found;
    for (const OwnedCurve& owned : m_curves)
    {
        if (distance(*owned.curve, p) > m_context.ball_radius + tolerance)
            continue;
        const Point normal = unit(p - closest_point(*owned.curve, p));
        if (supports(m_context.table.elements[owned.obstacle->element], normal))
            found.push_back({owned.obstacle->element, normal});
    }
    return found;
}

/// Whether some pair of normals, or one of them alone, carries the weight: up lies between them.
bool RestSearch::is_held(const std::vector<Support>& supports) const
{
    for (const Support& a : supports)
    {
        if (a.normal.y > 0 && std::abs(a.normal.x) < level_slope)
            return true;
        for (const Support& b : supports)
            if (a.normal.x < 0 && b.normal.x > 0 && b.normal.x * a.normal.y - a.normal.x * b.normal.y > 1e-9)
                return true;
    }
    return false;
}

/// The grid ends before the tip of a pointed pocket. The ball comes there along the middle of it, between what holds it.
bool RestSearch::is_reached(Point p, const std::vector<Support>& supports) const
{
    Point out{};
    for (const Support& support : supports)
        out = out + support.normal;
    const bool has_middle = length(out) > 1e-3;
    for (Point q = p; length(q - p) < 4 * m_context.ball_radius; q = q + Reach::cell_size * unit(out))
    {
        if (m_context.reach.comes_within(q, 2 * Reach::cell_size))
            return true;
        if (!has_middle || !is_free(q))
            return false;
    }
    return false;
}

/// True if a ball rests here.
bool RestSearch::consider(Point p)
{
    const bool known = std::any_of(m_found.begin(), m_found.end(), [&](Point q) { return length(p - q) < 0.0005; });
    if (known || !contains(m_context.outline, p) || !is_free(p))
        return known;
    const std::vector<Support> supports = supports_at(p);
    if (!is_held(supports) || is_taken_away(m_context, p) || !is_reached(p, supports))
        return false;
    std::vector<Index> elements;
    for (const Support& support : supports)
    {
        if (moves_on(m_context.table.elements[support.element]))
            return false;
        if (std::find(elements.begin(), elements.end(), support.element) == elements.end())
            elements.push_back(support.element);
    }
    m_found.push_back(p);
    m_context.report(FindingKind::RestingPlace, std::move(elements), p,
                     "a ball can come to rest at " + short_number(p.x) + ", " + short_number(p.y) +
                         (m_targets_up ? " with the drop targets up" : ""));
    return true;
}

/// The lowest point of a bowl and the middle of a level line hold a ball without a second support.
void RestSearch::consider_level_piece(const Track& track)
{
    if (track.is_circle && track.curve->is_arc && track.radius < track.curve->radius)
        consider(track.center - Point{0, track.radius});
    const Point along = unit(track.b - track.a);
    if (!track.is_circle && std::abs(along.y) < level_slope)
        for (const double share : {0.5, 0.25, 0.75})
            if (consider(track.a + share * (track.b - track.a)))
                return;
}

bool RestSearch::close_enough(const Track& a, const Track& b) const
{
    return a.curve != b.curve && closest_approach(*a.curve, *b.curve).clearance <= 2 * m_context.ball_radius;
}

void RestSearch::run()
{
    for (std::size_t i = 0; i < m_tracks.size(); ++i)
    {
        consider_level_piece(m_tracks[i]);
        for (std::size_t j = i + 1; j < m_tracks.size(); ++j)
            if (close_enough(m_tracks[i], m_tracks[j]))
                for (const Point p : crossings(m_tracks[i], m_tracks[j]))
                    consider(p);
    }
}

} // namespace

void check_resting_places(CheckContext& context)
{
    std::vector<Point> found;
    RestSearch(context, false, found).run();
    const auto is_drop_target = [](const Element& element) { return std::holds_alternative<DropTarget>(element.part); };
    if (std::any_of(context.table.elements.begin(), context.table.elements.end(), is_drop_target))
        RestSearch(context, true, found).run();
}

} // namespace carom::pinball
