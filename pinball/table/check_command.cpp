#include "pinball/table/check_command.h"

#include "pinball/table/checker.h"
#include "pinball/table/loader.h"

namespace carom::pinball {
namespace {

int print_errors(const std::filesystem::path& file, const LoadErrors& errors, std::ostream& out)
{
    for (const LoadError& error : errors)
        out << file.string() << ":" << (error.line > 0 ? "" : " ") << to_string(error) << "\n";
    out << file.string() << ": " << errors.size() << (errors.size() == 1 ? " error" : " errors") << "\n";
    return 1;
}

int line_of(const Table& table, const Finding& finding)
{
    const Index element = finding.elements.empty() ? none : table.find(finding.elements.front());
    return element == none ? 0 : table.elements[element].line;
}

} // namespace

int check_command(const std::filesystem::path& file, std::ostream& out)
{
    const LoadResult loaded = load_table_file(file);
    if (!loaded.table)
        return print_errors(file, loaded.errors, out);
    const std::vector<Finding> findings = check(*loaded.table);
    for (const Finding& finding : findings)
    {
        const int line = line_of(*loaded.table, finding);
        out << file.string() << ":" << (line > 0 ? std::to_string(line) + ":" : "") << " " << to_string(finding) << "\n";
    }
    if (findings.empty())
        out << file.string() << ": \"" << loaded.table->name << "\", " << loaded.table->elements.size()
            << " elements, nothing found\n";
    else
        out << file.string() << ": " << findings.size() << (findings.size() == 1 ? " finding" : " findings") << "\n";
    return findings.empty() ? 0 : 1;
}

} // namespace carom::pinball
