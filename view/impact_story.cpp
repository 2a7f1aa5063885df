#include "view/impact_story.h"

#include "view/words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace carom::view {
namespace {

using Kind = StoryLine::Kind;

constexpr float digits_tell = 5e-4f; // of a number: what its three digits can tell

// Where all that holds it is a hinge to something that stands still.
void find_pivot(const Scene& scene, const ConstBody& body, const ImpactEvent& event, ImpactParty& p)
{
    const std::vector<JointId> joints = body.joints();
    p.jointed = !joints.empty();
    if (joints.size() != 1)
        return;
    const ConstJoint joint = scene.joint(joints.front());
    const JointDef def = joint.def();
    const BodyId other = joint.body_a() == body.id() ? joint.body_b() : joint.body_a();
    const bool stands = !scene.is_valid(other) || scene.body(other).type() == BodyType::Static;
    if (!std::holds_alternative<RevoluteDef>(def) || !stands)
        return;
    const Position pivot = joint.body_a() == body.id() ? joint.anchor_b() : joint.anchor_a();
    const float off = length(body.center_of_mass() - pivot);
    p.pivot_inertia = p.inertia + p.mass * off * off;
    p.pivot_arm = std::abs(cross(event.point - pivot, event.normal));
}

ImpactParty party(const Scene& scene, const ImpactEvent& event, bool first, const ShapeNamer& namer)
{
    const BodyId id = first ? event.body_a : event.body_b;
    const ShapeId shape = first ? event.shape_a : event.shape_b;
    const char* fallback = first ? "A" : "B";
    ImpactParty p;
    p.name = namer && scene.is_valid(shape) ? namer(scene, shape) : fallback;
    if (!scene.is_valid(id))
        return p;
    const ConstBody body = scene.body(id);
    p.type = body.type();
    p.mass = body.mass();
    p.inertia = body.inertia();
    const MotionLocks locks = body.locks();
    p.held = locks.linear_x && locks.linear_y;
    find_pivot(scene, body, event, p);
    return p;
}

float reduced_mass(float a, float b)
{
    if (a <= 0)
        return b;
    if (b <= 0)
        return a;
    return a * b / (a + b);
}

// 3.2·10⁻⁶ is more than one sign.
std::string squared(float value)
{
    const std::string text = number(value);
    return text.find("·") == std::string::npos ? text + "²" : "(" + text + ")²";
}

std::string with_index(const char* symbol, bool first) { return std::string(symbol) + (first ? "₁" : "₂"); }

void tell_fixed(std::vector<StoryLine>& story, const ImpactParty& p, bool first)
{
    const char* sentence = p.type == BodyType::Kinematic ? "is told" : "is fixed";
    story.push_back({Kind::Text, say(sentence, {{"name", p.name}, {"m", with_index("m", first)}})});
}

void tell_held(std::vector<StoryLine>& story, const ImpactParty& p, float effective, bool first)
{
    const std::string r = number(lever_arm(p, effective));
    story.push_back({Kind::Text, say("is held", {{"name", p.name}, {"r", r}})});
    story.push_back({Kind::Formula, with_index("m", first) + " = " + number(p.inertia) + " / " +
                                        squared(lever_arm(p, effective)) + " = " + number(effective) + " kg"});
}

void tell_free(std::vector<StoryLine>& story, const ImpactParty& p, float effective, bool first)
{
    const float r = lever_arm(p, effective);
    const std::string m = with_index("m", first);
    if (r <= 0)
    {
        story.push_back({Kind::Text, say("is central", {{"name", p.name}})});
        story.push_back({Kind::Formula, m + " = " + number(effective) + " kg"});
        return;
    }
    story.push_back({Kind::Text, say("is beside", {{"name", p.name}, {"r", number(r)}})});
    story.push_back({Kind::Formula, m + " = 1 / (1/" + number(p.mass) + " + " + squared(r) + "/" + number(p.inertia) +
                                        ") = " + number(effective) + " kg"});
}

// The event's mass is that of the whole mechanism; only a plain pivot can be checked by hand.
void tell_jointed(std::vector<StoryLine>& story, const ImpactParty& p, float effective, bool first)
{
    const float of_pivot = p.pivot_arm > 0 ? p.pivot_inertia / (p.pivot_arm * p.pivot_arm) : 0;
    const std::string m = with_index("m", first);
    if (std::abs(of_pivot - effective) > 0.01f * effective)
    {
        story.push_back({Kind::Text, say("is jointed", {{"name", p.name}})});
        story.push_back({Kind::Formula, m + " = " + number(effective) + " kg"});
        return;
    }
    const std::string r = number(p.pivot_arm);
    story.push_back({Kind::Text, say("is on pivot", {{"name", p.name}, {"r", r}})});
    story.push_back(
        {Kind::Formula, m + " = " + number(p.pivot_inertia) + " / " + squared(p.pivot_arm) + " = " + number(effective) + " kg"});
}

void tell_mass(std::vector<StoryLine>& story, const ImpactParty& p, float effective, bool first)
{
    if (effective <= 0)
        tell_fixed(story, p, first);
    else if (p.held)
        tell_held(story, p, effective, first);
    else if (p.jointed)
        tell_jointed(story, p, effective, first);
    else
        tell_free(story, p, effective, first);
}

// Not "(" + number(value): g++ 12 warns of an overlap that is none.
std::string bracketed(float value)
{
    std::string text = number(value);
    if (value >= 0)
        return text;
    text.insert(text.begin(), '(');
    text += ')';
    return text;
}

void tell_speed(std::vector<StoryLine>& story, const ImpactEvent& e)
{
    story.push_back({Kind::Step, say("how fast")});
    story.push_back({Kind::Text, say("speeds")});
    story.push_back({Kind::Formula, "v₁ − v₂ = " + number(e.speed_a) + " − " + bracketed(e.speed_b) + " = " +
                                        number(e.approach_speed) + " m/s"});
}

void tell_bounce(std::vector<StoryLine>& story, const ImpactEvent& e)
{
    const int percent = static_cast<int>(std::lround(100 * e.restitution));
    story.push_back({Kind::Step, say("how bouncy")});
    story.push_back({Kind::Text, say("bounciness", {{"e", number(e.restitution)}, {"percent", std::to_string(percent)}})});
}

void tell_blow(std::vector<StoryLine>& story, const ImpactRecord& record)
{
    const ImpactEvent& e = record.event;
    const std::string bounce = "(1+" + number(e.restitution) + ")·";
    const std::string speed = "·" + number(e.approach_speed);
    const std::string m1 = number(e.effective_mass_a);
    const std::string m2 = number(e.effective_mass_b);
    const bool both = e.effective_mass_a > 0 && e.effective_mass_b > 0;
    story.push_back({Kind::Step, say("so the blow is")});
    story.push_back({Kind::Formula, say("blow")});
    if (!both)
        story.push_back({Kind::Text, say("infinite mass")});
    const std::string masses = both ? m1 + "·" + m2 + "/(" + m1 + "+" + m2 + ")" : e.effective_mass_a > 0 ? m1 : m2;
    const float mass = reduced_mass(e.effective_mass_a, e.effective_mass_b);
    story.push_back({Kind::Formula,
                     "j = " + bounce + masses + speed + " = " + number((1 + e.restitution) * mass * e.approach_speed) + " N·s"});
    if (e.kick_speed > 0)
        story.push_back(
            {Kind::Formula, say("kick", {{"speed", number(e.kick_speed)}, {"impulse", number(mass * e.kick_speed)}})});
}

// Nobody else took part in the blow.
bool is_as_by_formula(const ImpactRecord& record)
{
    const float formula = impulse_by_formula(record);
    const float engine = record.event.impulse;
    return std::abs(formula - engine) <= digits_tell * std::max(formula, engine) || number(formula) == number(engine);
}

void tell_check(std::vector<StoryLine>& story, const ImpactRecord& record)
{
    const float engine = record.event.impulse;
    const bool same = is_as_by_formula(record);
    story.push_back({Kind::Result, say(same ? "engine same" : "engine differs", {{"impulse", number(engine)}})});
    if (!same)
        story.push_back({Kind::Text, say("why it differs")});
}

// By the impulse over the mass, where nothing else moved it at that moment.
void tell_change(std::vector<StoryLine>& story, const ImpactParty& p, float effective, float before, float after, float impulse,
                 bool first, bool undisturbed)
{
    if (effective <= 0)
        return;
    const std::string v = with_index("v", first);
    const std::string sign = first ? " − " : " + ";
    const float change = impulse / effective;
    const float by_formula = first ? before - change : before + change;
    const float scale = std::max({std::abs(before), std::abs(after), change});
    const bool is_alone = std::abs(by_formula - after) <= 0.2f * digits_tell * scale;
    const bool turns = !p.held && !p.jointed && lever_arm(p, effective) > 0;
    const std::string sum = v + sign + "j/" + with_index("m", first) + " = " + number(before) + sign + number(impulse) + "/" +
                            number(effective) + " = ";
    // The engine's number may round to another last digit than the sum. A sum that is a small difference has lost its own digits.
    const float shown = is_alone && std::abs(by_formula) > 0.5f * scale ? by_formula : after;
    const char* sentence = is_alone ? (turns ? "change of spot" : "change") : turns ? "change of spot from" : "change from";
    story.push_back(
        {Kind::Formula,
         say(sentence, {{"name", p.name}, {"way", sum}, {"v", v}, {"before", number(before)}, {"after", number(shown)}})});
    if (turns && undisturbed)
        story.push_back({Kind::Formula, say("centre", {{"name", p.name},
                                                       {"impulse", number(impulse)},
                                                       {"mass", number(p.mass)},
                                                       {"change", number(impulse / p.mass)}})});
}

// The impulse along the surface, and whether it has stopped the sliding: by the speeds that they have afterwards.
void tell_friction(std::vector<StoryLine>& story, const ImpactEvent& e)
{
    const float rubbed = std::abs(e.friction_impulse);
    if (e.friction <= 0 || rubbed <= digits_tell * e.impulse)
        return;
    const float sliding = std::abs(cross(e.normal, e.velocity_after_b - e.velocity_after_a));
    story.push_back({Kind::Step, say("along the surface")});
    story.push_back({Kind::Formula, say("most friction", {{"mu", number(e.friction)},
                                                          {"impulse", number(e.impulse)},
                                                          {"most", number(e.friction * e.impulse)}})});
    const bool stops = sliding <= 1e-3f * e.approach_speed;
    story.push_back({Kind::Text, say(stops ? "friction stops" : "friction slides",
                                     {{"friction", number(rubbed)}, {"speed", number(sliding)}})});
}

// From the speeds that they had, not from what should have been.
void tell_parting(std::vector<StoryLine>& story, const ImpactRecord& record)
{
    const ImpactEvent& e = record.event;
    const float parting = dot(e.velocity_after_b - e.velocity_after_a, e.normal);
    const float by_formula = e.restitution * e.approach_speed + e.kick_speed;
    const bool kicked = e.kick_speed > 0;
    const std::string formula = number(e.restitution) + "·" + number(e.approach_speed) +
                                (kicked ? " + " + number(e.kick_speed) : "") + " = " + number(by_formula);
    if (std::abs(parting - by_formula) <= 2 * digits_tell * std::max(e.approach_speed, std::abs(by_formula)))
    {
        story.push_back({Kind::Formula, say(kicked ? "part with kick" : "part as told", {{"formula", formula}})});
        return;
    }
    const char* how = std::abs(parting) <= 1e-4f * e.approach_speed ? "stay together" : parting > 0 ? "part" : "still approach";
    story.push_back({Kind::Text, say(how, {{"speed", number(std::abs(parting))}})});
    story.push_back({Kind::Formula, say(kicked ? "alone with kick" : "alone", {{"formula", formula}})});
    const bool rubbed = std::abs(e.friction_impulse) > digits_tell * e.impulse;
    story.push_back({Kind::Text, say(rubbed && is_as_by_formula(record) ? "friction turned" : "others")});
}

void tell_after(std::vector<StoryLine>& story, const ImpactRecord& record)
{
    const ImpactEvent& e = record.event;
    const bool undisturbed = is_as_by_formula(record);
    story.push_back({Kind::Step, say("afterwards")});
    tell_parting(story, record);
    tell_change(story, record.a, e.effective_mass_a, e.speed_a, dot(e.velocity_after_a, e.normal), e.impulse, true, undisturbed);
    tell_change(story, record.b, e.effective_mass_b, e.speed_b, dot(e.velocity_after_b, e.normal), e.impulse, false, undisturbed);
    story.push_back({Kind::Text, say(e.energy_lost >= 0 ? "lost" : "won", {{"energy", number(std::abs(e.energy_lost))}})});
}

std::string superscript(int value)
{
    static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(value))
        text += c == '-' ? "⁻" : digits[c - '0'];
    return text;
}

} // namespace

std::string number(float value)
{
    if (!std::isfinite(value))
        return value > 0 ? "∞" : value < 0 ? "−∞" : "?";
    const std::string sign = value < 0 ? "−" : "";
    const double size = std::abs(static_cast<double>(value));
    if (size == 0)
        return "0";
    char text[48];
    std::snprintf(text, sizeof text, "%.2e", size);
    const int exponent = std::atoi(std::string(text).substr(5).c_str());
    if (exponent < -3 || exponent > 5)
        return sign + std::string(text, 4) + "·10" + superscript(exponent);
    std::snprintf(text, sizeof text, "%.*f", std::clamp(2 - exponent, 0, 6), size);
    return sign + text;
}

std::string kind_name(const Scene& scene, ShapeId shape)
{
    static constexpr const char* names[] = {"ball", "polygon", "capsule", "wall", "arc", "rail", "floor"};
    const ConstShape s = scene.shape(shape);
    const Geometry geometry = s.geometry();
    const auto* polygon = std::get_if<Polygon>(&geometry);
    std::string name = polygon != nullptr && polygon->vertices.size() == 4 ? "box" : names[geometry.index()];
    if (scene.body(s.body()).type() != BodyType::Static)
        name += ' ' + std::to_string(s.body().slot);
    return name;
}

ImpactRecord record_impact(const Scene& scene, const ImpactEvent& event, const ShapeNamer& namer)
{
    return {event, party(scene, event, true, namer), party(scene, event, false, namer), scene.time()};
}

float impulse_by_formula(const ImpactRecord& record)
{
    const ImpactEvent& e = record.event;
    return reduced_mass(e.effective_mass_a, e.effective_mass_b) * ((1 + e.restitution) * e.approach_speed + e.kick_speed);
}

float lever_arm(const ImpactParty& p, float effective_mass)
{
    if (effective_mass <= 0 || p.inertia <= 0)
        return 0;
    const float turning = 1 / effective_mass - (p.held || p.mass <= 0 ? 0 : 1 / p.mass);
    // Below a ten-thousandth of the whole it is rounding, not a lever.
    return turning > 1e-4f / effective_mass ? std::sqrt(turning * p.inertia) : 0;
}

std::vector<StoryLine> impact_story(const ImpactRecord& record)
{
    const ImpactEvent& e = record.event;
    std::vector<StoryLine> story;
    char time[32];
    std::snprintf(time, sizeof time, "%.3f", record.time);
    story.push_back({Kind::Title, say("title", {{"a", record.a.name}, {"b", record.b.name}, {"time", time}})});
    story.push_back({Kind::Step, say("how heavy")});
    story.push_back({Kind::Formula, say("point mass")});
    tell_mass(story, record.a, e.effective_mass_a, true);
    tell_mass(story, record.b, e.effective_mass_b, false);
    tell_speed(story, e);
    tell_bounce(story, e);
    tell_blow(story, record);
    tell_check(story, record);
    tell_friction(story, e);
    tell_after(story, record);
    return story;
}

void ImpactWatch::observe(const Scene& scene)
{
    const ImpactEvent* strongest = nullptr;
    for (const ImpactEvent& e : scene.impacts())
        if (strongest == nullptr || e.impulse > strongest->impulse)
            strongest = &e;
    if (strongest == nullptr)
        return;
    const bool fresh = m_last && scene.time() >= m_last->time && scene.time() - m_last->time < m_hold;
    if (fresh && m_last->event.impulse >= strongest->impulse)
        return;
    m_last = record_impact(scene, *strongest, m_namer);
}

} // namespace carom::view
