#pragma once

/// @file
/// The content of a loaded table file: plain data, SI units, radians. docs/table-format.md describes the file itself.
///
/// The playfield lies in the plane of the scene: x to the right, y up the table, the origin at the lower left corner.
/// Every shape is given where it stands in the world. References between parts are indices, `none` where there is none.

#include "carom/math.h"
#include "carom/shape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace carom::pinball {

/// Index into Table::elements, materials or groups.
using Index = std::uint32_t;
inline constexpr Index none = ~Index{0};

struct Color
{
    std::uint8_t r = 255;
    std::uint8_t g = 255;
    std::uint8_t b = 255;
    friend constexpr bool operator==(Color, Color) = default;
};

/// How a surface answers the ball. The surface alone decides a bounce; the ball's own material counts only between
/// balls (MixRule::OtherDecides with ShapeDef::yields_material on balls).
struct Material
{
    std::string name{};
    float restitution = 0;    ///< at approach speed 0
    RestitutionCurve curve{}; ///< over the approach speed; count 0: restitution holds at every speed
    float friction = 0;
};

// --- Elements: one struct per type of the file ------------------------------------------------------------------

/// A thin wall along a path: `path` is open and carries half thickness and sides.
struct Wall
{
    Chain path{};
};

/// A closed outline, counter-clockwise: its right is the outside.
struct Solid
{
    Chain path{};
};

struct Post
{
    Vec2 pos{};
    float radius = 0;
};

/// Solid where dot(normal, p - point) < 0.
struct Plane
{
    Vec2 point{};
    Vec2 normal{}; ///< unit length
};

enum class Side : std::uint8_t
{
    Left,
    Right,
};

/// A tapered bat that turns about its pivot between two stops. Angles from the x axis, counter-clockwise.
/// The stroke is the direct way from rest to up: less than pi either way.
struct Flipper
{
    Vec2 pivot{};
    float length = 0; ///< pivot to the centre of the tip circle
    float base_radius = 0;
    float tip_radius = 0;
    float rest = 0;              ///< rad
    float up = 0;                ///< rad
    float inertia = 0;           ///< about the pivot, kg m²
    float coil_torque = 0;       ///< N m
    float coil_rise = 0;         ///< s until the coil has its full torque
    float hold_torque_ratio = 0; ///< torque share that is left at the end of the stroke
    float eos = 0;               ///< rad before the up stop from where the torque fades to the hold share
    float return_ratio = 0;      ///< return spring torque over coil torque
    float stop_restitution = 0;  ///< speed kept at a stop
    Side input = Side::Left;
};

/// A rod on a slider with a spring. It pushes along `axis`; pulled back it has moved by `stroke` against it.
struct Plunger
{
    Vec2 pos{};  ///< centre of the rod's head at rest
    Vec2 half{}; ///< half sizes across and along the axis
    Vec2 axis{}; ///< unit length, towards the ball
    float stroke = 0;
    float mass = 0;
    float k = 0;          ///< N/m
    float c = 0;          ///< N s/m
    float preload = 0;    ///< N at rest
    float pull_speed = 0; ///< m/s while the key is held
    Index lane = none;    ///< the sensor in which a ball waits for this plunger
};

/// A pop bumper. Adds kick_speed along the normal when a ball arrives faster than the threshold.
struct Bumper
{
    Vec2 pos{};
    float radius = 0;
    float kick_speed = 0; ///< m/s
    float threshold = 0;  ///< m/s
    float cooldown = 0;   ///< s
};

/// A rounded triangle, counter-clockwise. The edge from corners[0] to corners[1] kicks, the others are plain walls.
struct Slingshot
{
    std::array<Vec2, 3> corners{};
    float radius = 0;
    float kick_speed = 0;
    float threshold = 0;
    float cooldown = 0;
};

/// A target that falls when hit and is raised with its group, never into a ball.
struct DropTarget
{
    Vec2 a{};
    Vec2 b{};
    float radius = 0;    ///< half thickness
    float min_speed = 0; ///< approach speed that counts as a hit, m/s
};

/// A fixed target.
struct Standup
{
    Vec2 a{};
    Vec2 b{};
    float radius = 0;
    float min_speed = 0;
};

struct TargetSpring
{
    Vec2 anchor{}; ///< world point
    Vec2 local{};  ///< on the target, from its centre
    float k = 0;   ///< N/m
    float c = 0;   ///< N s/m
    float rest = 0;
};

/// A box on springs that slides along `axis` without turning: pushed in by up to max_travel.
struct SprungTarget
{
    Vec2 pos{};
    Vec2 half{}; ///< half sizes along x and y
    Vec2 axis{}; ///< unit length, the way it is pushed in
    float mass = 0;
    float max_travel = 0;
    float min_impulse = 0; ///< N s that counts as a hit
    std::vector<TargetSpring> springs{};
};

/// A flag across a lane that a passing ball turns and that slows the ball.
struct Spinner
{
    Vec2 a{};
    Vec2 b{};
    float inertia = 0;      ///< kg m²
    float damping = 0;      ///< 1/s
    float drag_on_ball = 0; ///< share of its speed that a ball loses to set it turning
};

/// A one-way gate: passes what moves along open_dir.
struct Gate
{
    Vec2 a{};
    Vec2 b{};
    float radius = 0;
    Vec2 open_dir{}; ///< unit length
};

/// A rollover or a drain: a box, or a circle where radius > 0.
struct Sensor
{
    Vec2 pos{};
    Vec2 half{};
    float radius = 0;
    bool kills = false; ///< a ball that enters it leaves the game
};

/// A box that pushes balls inside it.
struct Booster
{
    Vec2 pos{};
    Vec2 half{};
    Vec2 force{}; ///< N
    bool only_if_moving_along = false;
};

/// A kickback: while lit, it gives a ball that enters its box this velocity.
struct Kicker
{
    Vec2 pos{};
    Vec2 half{};
    Vec2 kick{};      ///< m/s
    bool lit = false; ///< at the start of a game
};

/// A hole that catches a slow ball, holds it and throws it out.
struct Saucer
{
    Vec2 pos{};
    float radius = 0;
    float max_capture_speed = 0; ///< m/s
    float hold = 0;              ///< s
    Vec2 kick{};                 ///< m/s
    float spread = 0;            ///< rad, half width of the seeded scatter of the kick
};

/// A ball that stays in its place on the table.
struct CaptiveBall
{
    Vec2 pos{};
};

/// The source of a light: the state of an element (rollover made, target down, kicker lit), or of the game.
enum class Lamp : std::uint8_t
{
    Element,
    BallSave,
    Bonus,  ///< bonus multiplier has reached `number`
    Letter, ///< letter `number` of the bank rule, from 1
    Lock,
    Multiball,
    ExtraBall,  ///< blinks while the shot would win one
    ShootAgain, ///< an extra ball waits
};

/// An insert in the playfield. Drawn only.
struct Light
{
    Vec2 pos{};
    float radius = 0;
    Lamp shows = Lamp::Element;
    Index element = none; ///< with Lamp::Element
    int number = 0;       ///< with Lamp::Bonus and Lamp::Letter
    std::string label{};
};

using Part = std::variant<Wall, Solid, Post, Plane, Flipper, Plunger, Bumper, Slingshot, DropTarget, Standup, SprungTarget,
                          Spinner, Gate, Sensor, Booster, Kicker, Saucer, CaptiveBall, Light>;

/// The names of the types in the file, in the order of Part.
inline constexpr std::array<std::string_view, std::variant_size_v<Part>> type_names = {
    "wall",          "solid",   "post", "plane",  "flipper", "plunger", "bumper", "slingshot", "drop_target", "standup",
    "sprung_target", "spinner", "gate", "sensor", "booster", "kicker",  "saucer", "ball",      "light"};

struct Element
{
    std::string id{};
    Part part{};
    Index material = none; ///< set on everything that a ball can touch; none on sensors, fields and lights
    Index group = none;
    int score = 0;
    bool enabled = true; ///< takes part in the game from the start
    bool visible = true;
    int layer = 0; ///< of drawing only: higher is drawn later
    std::optional<Color> color{};
    int line = 0; ///< in the file, from 1; 0 unknown
};

[[nodiscard]] inline std::string_view type_name(const Element& element) { return type_names[element.part.index()]; }

// --- Groups and rules ---------------------------------------------------------------------------------------------

enum class GroupReset : std::uint8_t
{
    Never,        ///< stays complete until the next ball
    WhenComplete, ///< starts anew reset_delay after it was completed
};

/// Elements that are made one by one and count when all are: lanes, a drop bank.
struct Group
{
    std::string id{};
    std::vector<Index> members{}; ///< in the order of lane change
    GroupReset reset = GroupReset::Never;
    float reset_delay = 0;    ///< s
    bool lane_change = false; ///< a flipper press turns the lit members round
    int score = 0;            ///< when complete
};

/// The rules are state machines in pinball/rules, fed by events of elements (hit, enter, exit, spin, group complete).
/// The table names their parameters and the elements that play in them. A rule that is absent is not played.
struct BallSaveRule
{
    float time = 0;  ///< s from the first switch of the playfield
    float grace = 0; ///< s after the light is out
    int per_ball = 1;
};

struct SkillShotRule
{
    Index group = none; ///< one member flashes
    int score = 0;
    int increase = 0; ///< added for each one made before
};

struct LaneRule
{
    Index group = none;
    Index kicker = none; ///< lit again when the lanes are complete; none: nothing
};

struct BankRule
{
    Index group = none;
    std::string letters{}; ///< one for each completion
    int score = 0;         ///< when the word is spelled
};

struct BumperRule
{
    int hits_per_level = 0;
    std::vector<int> scores{}; ///< per hit, by level
};

struct SpinnerRule
{
    Index spinner = none;
    Index trigger = none; ///< sensor that multiplies the spinner
    int factor = 1;
    float time = 0; ///< s
};

struct ComboRule
{
    std::vector<Index> shots{};
    float window = 0; ///< s from one shot to the next
    int score = 0;    ///< times the length of the chain
    int max = 0;
};

struct ExtraBallRule
{
    Index group = none; ///< its completions light the extra ball
    int completions = 1;
    Index shot = none; ///< wins it when it is lit
    int per_game = 1;  ///< each player
};

struct ReplayRule
{
    int score = 0;
    bool wins_a_ball = false; ///< else a game
};

struct MultiballRule
{
    Index target = none; ///< its hits light the lock
    int hits = 0;
    Index saucer = none;
    int locks = 0;
    int balls = 0;
    float ball_save = 0; ///< s
    int jackpot = 0;
    std::vector<Index> jackpots{}; ///< elements that pay it, in turn
};

struct Rules
{
    int balls = 3;
    int bonus_per_switch = 0;
    int bonus_multiplier_max = 1;
    int tilt_warnings = 2; ///< touches of the bob on a ball before the one that ends it
    float ball_search = 8; ///< s without a switch after which the coils look for the ball; 0: never
    std::optional<BallSaveRule> ball_save{};
    std::optional<SkillShotRule> skill_shot{};
    std::optional<LaneRule> lanes{};
    std::optional<BankRule> bank{};
    std::optional<BumperRule> bumpers{};
    std::optional<SpinnerRule> spinner{};
    std::optional<ComboRule> combo{};
    std::optional<MultiballRule> multiball{};
    std::optional<ExtraBallRule> extra_ball{};
    std::optional<ReplayRule> replay{};
    bool match = false; ///< at the end of a game a number is drawn; whose score ends in it wins a game
};

// --- The table ----------------------------------------------------------------------------------------------------

struct BallDef
{
    float radius = 0;
    float mass = 0;
    Vec2 spawn{};
    Index material = none;
};

struct Physics
{
    float g = 9.81f;        ///< m/s²
    float slope = 0;        ///< of the table, rad
    float step = 0.001f;    ///< s
    float mu_playfield = 0; ///< friction between ball and playfield
    float scatter = 0;      ///< of the speeds that plunger and coils give: a share up or down, drawn anew for each
};

/// The cabinet on its legs, what a nudge does to it, and the bob that hangs in it. x is sideways, y along the table.
struct CabinetDef
{
    Vec2 nudge_speed{0.28f, 0.165f}; ///< that a push would give a cabinet without legs, m/s
    float push_time = 0.025f;        ///< s
    Vec2 frequency{9.3f, 5.8f};      ///< of the cabinet on its legs, Hz
    Vec2 damping{0.052f, 0.055f};    ///< share of the critical damping
    float tilt = 3.0f * pi / 180;    ///< of the bob when it touches its ring, rad
    float bob_length = 0.1f;         ///< m
};

/// A line of the rules card: what something is called and what it is for.
struct CardEntry
{
    std::string name{};
    std::string text{};
};

struct Table
{
    std::string name{};
    std::string author{};
    Vec2 size{};
    BallDef ball{};
    Physics physics{};
    CabinetDef cabinet{};
    std::vector<Material> materials{};
    std::vector<Element> elements{}; ///< in the order of the file
    std::vector<Group> groups{};
    Rules rules{};
    std::vector<CardEntry> card{}; ///< the rules as the player reads them
    Index outline = none;          ///< the wall that surrounds the game; closed by a straight line from its end to its start

    /// The index of the element with this id, or none.
    [[nodiscard]] Index find(std::string_view id) const
    {
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (elements[i].id == id)
                return static_cast<Index>(i);
        return none;
    }
};

} // namespace carom::pinball
