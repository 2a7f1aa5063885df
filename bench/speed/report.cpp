#include "speed/report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <ostream>

namespace speed {
namespace {

std::string number(double value, int digits)
{
    if (std::isnan(value))
        return "-";
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string hex(std::uint64_t value)
{
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

/// Cells of one width each, to the right; the first two to the left.
class Line
{
public:
    Line& add(const std::string& text)
    {
        const std::string fill(text.size() < width() ? width() - text.size() : 0, ' ');
        m_text += m_cells < 2 ? text + fill : fill + text;
        m_text += "  ";
        ++m_cells;
        return *this;
    }
    Line& add(double value, int digits) { return add(number(value, digits)); }
    void print(std::ostream& out) const { out << m_text << std::endl; }

private:
    [[nodiscard]] std::size_t width() const { return m_cells == 0 ? 13 : m_cells == 1 ? 9 : 8; }
    std::string m_text;
    int m_cells = 0;
};

nlohmann::ordered_json value_or_null(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

struct Measure
{
    const char* name;
    double value;
};

std::vector<Measure> measures(const Result& r)
{
    const Quality& q = r.quality;
    return {{"mean_overlap", q.overlap.mean},
            {"p99_overlap", q.overlap.p99},
            {"worst_overlap", q.overlap.worst},
            {"mean_joint", q.joint.mean},
            {"p99_joint", q.joint.p99},
            {"worst_joint", q.joint.worst},
            {"mean_drift", q.drift.mean},
            {"p99_drift", q.drift.p99},
            {"worst_drift", q.drift.worst},
            {"mean_speed", q.speed.mean},
            {"p99_speed", q.speed.p99},
            {"near_pairs", q.near_pairs},
            {"awake", q.awake},
            {"moving", q.moving},
            {"kinetic_energy", q.energy},
            {"bytes_per_body", r.bytes_per_body},
            {"bytes_per_contact", r.bytes_per_contact},
            {"peak_mb", r.peak_mb}};
}

nlohmann::ordered_json stages_of(const Result& result)
{
    if (!result.has_stages)
        return {};
    nlohmann::ordered_json stages;
    for (std::size_t i = 0; i < stage_names.size(); ++i)
        stages[stage_names[i]] = result.stages[i];
    return stages;
}

} // namespace

void print_times_header(std::ostream& out)
{
    Line line;
    for (const char* title : {"scene", "engine", "threads", "bodies", "joints", "contacts", "steps", "ms", "cpu ms"})
        line.add(title);
    for (const char* stage : stage_names)
        line.add(stage);
    line.add("hash").print(out);
}

void print_times(std::ostream& out, const Result& r)
{
    Line line;
    line.add(r.scene).add(r.engine);
    for (const int count : {r.threads, r.bodies, r.joints, r.contacts, r.steps})
        line.add(std::to_string(count));
    line.add(r.ms, 0).add(r.cpu_ms, 0);
    for (const double stage : r.stages)
        line.add(r.has_stages ? stage : none, 0);
    line.add(hex(r.hash) + (r.repeats ? "" : " NOT THE SAME EVERY TIME")).print(out);
}

void print_quality(std::ostream& out, const std::vector<Result>& results)
{
    out << "\nLast half of the run: mean, 99th percentile and worst of overlaps, of the gaps of hinges, of how far what is built "
           "at rest has\n"
           "strayed (mm) and of its speed (mm/s);\n"
           "mean number of pairs nearer than 2 cm and mean kinetic energy (kJ).\n"
           "Whole run: mean numbers of bodies that are awake and that move\n";
    Line header;
    for (const char* title : {"scene", "engine", "overlap", "99 %", "worst", "hinge", "99 %", "worst", "drift", "99 %", "worst",
                              "speed", "99 %", "worst", "near", "energy", "awake", "moving"})
        header.add(title);
    header.print(out);
    for (const Result& r : results)
    {
        const Quality& q = r.quality;
        Line line;
        line.add(r.scene).add(r.engine);
        for (const Spread& s : {q.overlap, q.joint, q.drift, q.speed})
            line.add(s.mean * 1000, 3).add(s.p99 * 1000, 3).add(s.worst * 1000, 3);
        line.add(q.near_pairs, 0).add(q.energy / 1000, 3).add(q.awake, 0).add(q.moving, 0).print(out);
    }
}

void print_memory(std::ostream& out, const std::vector<Result>& results)
{
    out << "\nMemory: bytes a body once the scene is built, bytes more a contact at the end, peak in MB\n";
    Line header;
    for (const char* title : {"scene", "engine", "B/body", "B/contact", "peak"})
        header.add(title);
    header.print(out);
    for (const Result& r : results)
        Line().add(r.scene).add(r.engine).add(r.bytes_per_body, 0).add(r.bytes_per_contact, 0).add(r.peak_mb, 0).print(out);
}

void print_json(std::ostream& out, const std::vector<Result>& results)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Result& r : results)
    {
        nlohmann::ordered_json quality;
        for (const Measure& measure : measures(r))
            quality[measure.name] = value_or_null(measure.value);
        list.push_back({{"scene", r.scene},
                        {"engine", r.engine},
                        {"isa", r.isa},
                        {"threads", r.threads},
                        {"bodies", r.bodies},
                        {"contacts", r.contacts},
                        {"joints", r.joints},
                        {"steps", r.steps},
                        {"ms", r.ms},
                        {"cpu_ms", r.cpu_ms},
                        {"stages", stages_of(r)},
                        {"hash", hex(r.hash)},
                        {"quality", quality}});
    }
    out << list.dump(2) << std::endl;
}

void print_csv(std::ostream& out, const std::vector<Result>& results)
{
    out << "scene,engine,isa,threads,bodies,contacts,joints,steps,ms,cpu_ms";
    for (const char* stage : stage_names)
        out << ',' << stage;
    out << ",hash";
    for (const Measure& measure : measures({}))
        out << ',' << measure.name;
    out << '\n';
    for (const Result& r : results)
    {
        out << r.scene << ',' << r.engine << ',' << r.isa << ',' << r.threads << ',' << r.bodies << ',' << r.contacts << ','
            << r.joints << ',' << r.steps << ',' << r.ms << ',' << r.cpu_ms;
        for (const double stage : r.stages)
            out << ',' << (r.has_stages ? number(stage, 3) : "");
        out << ',' << hex(r.hash);
        for (const Measure& measure : measures(r))
            out << ',' << (std::isnan(measure.value) ? "" : number(measure.value, 9));
        out << '\n';
    }
}

} // namespace speed
