#include "truth/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace truth {
namespace {

std::string number(double value)
{
    if (std::isnan(value))
    {
        return "-";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

std::string padded(const std::string& text, int width)
{
    const std::size_t size = static_cast<std::size_t>(std::abs(width));
    const std::string fill(text.size() < size ? size - text.size() : 0, ' ');
    return width < 0 ? text + fill : fill + text;
}

bool row_ok(const Row& row) { return row.ours.ok() && row.converges; }

std::string verdict(const Row& row)
{
    if (!row.ours.has_bound())
    {
        return "";
    }
    return row.ours.ok() ? "ok" : "NO";
}

void print_row(std::ostream& out, const Results& results, const Row& row)
{
    const Metric& m = row.ours;
    out << "  " << padded(m.name, -62) << padded(number(m.exact), 9) << padded(number(m.value), 13) << padded(number(m.bound), 9)
        << padded(verdict(row), 5);
    if (results.convergence)
    {
        out << padded(number(m.error()), 13) << padded(number(row.finer_error), 13)
            << padded(!m.has_bound()  ? ""
                      : row.converges ? "ok"
                                      : "NO",
                      5);
    }
    for (const double peer : row.peers)
    {
        out << padded(number(peer), 16);
    }
    out << '\n';
}

nlohmann::json value_or_null(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

} // namespace

void print_header(std::ostream& out, const Results& results, double hz)
{
    out << "dt = 1/" << number(hz) << " s\n";
    out << padded("", -64) << padded("exact", 9) << padded("ours", 13) << padded("bound", 9) << padded("", 5);
    if (results.convergence)
    {
        out << padded("error", 13) << padded("at 4x rate", 13) << padded("", 5);
    }
    for (const std::string& name : results.peer_names)
    {
        out << padded(name, 16);
    }
    out << '\n';
}

void print_experiment(std::ostream& out, const Results& results, const Experiment& experiment)
{
    out << experiment.number << ". " << experiment.title << '\n';
    for (const Row& row : results.rows)
    {
        if (row.ours.experiment == experiment.number)
        {
            print_row(out, results, row);
        }
    }
    out << std::flush;
}

void print_summary(std::ostream& out, const Results& results)
{
    const auto bounded = std::count_if(results.rows.begin(), results.rows.end(), [](const Row& r) { return r.ours.has_bound(); });
    const auto kept =
        std::count_if(results.rows.begin(), results.rows.end(), [](const Row& r) { return r.ours.has_bound() && row_ok(r); });
    out << kept << " of " << bounded << " bounds kept\n";
}

void print_json(std::ostream& out, const Results& results)
{
    nlohmann::json list = nlohmann::json::array();
    for (const Row& row : results.rows)
    {
        const Metric& m = row.ours;
        nlohmann::json entry{{"experiment", m.experiment},      {"metric", m.name},
                             {"exact", value_or_null(m.exact)}, {"value", value_or_null(m.value)},
                             {"bound", value_or_null(m.bound)}, {"ok", m.ok()}};
        if (results.convergence)
        {
            entry["finer_error"] = value_or_null(row.finer_error);
            entry["converges"] = row.converges;
        }
        for (std::size_t i = 0; i < row.peers.size(); ++i)
        {
            entry["peers"][results.peer_names[i]] = value_or_null(row.peers[i]);
        }
        list.push_back(std::move(entry));
    }
    out << list.dump(2) << '\n';
}

bool all_ok(const Results& results) { return std::all_of(results.rows.begin(), results.rows.end(), row_ok); }

} // namespace truth
