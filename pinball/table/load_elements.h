#pragma once

#include "pinball/table/field_reader.h"

namespace carom::pinball {

/// Reads the array "elements" into the table. Materials must be there already.
void load_elements(const JsonNode& elements, const NameIndex& materials, Table& table, LoadErrors& errors);

/// The ids of the elements that hold one of these parts; an id that stands twice counts once.
template <typename... Parts>
[[nodiscard]] NameIndex names_of(const Table& table)
{
    NameIndex names;
    for (std::size_t i = 0; i < table.elements.size(); ++i)
        if ((std::holds_alternative<Parts>(table.elements[i].part) || ...))
            names.emplace(table.elements[i].id, static_cast<Index>(i));
    return names;
}

[[nodiscard]] NameIndex names_of_all(const Table& table);

/// Lower-case letters, digits and underscores, up to 40 of them.
[[nodiscard]] bool is_valid_id(std::string_view id);

} // namespace carom::pinball
