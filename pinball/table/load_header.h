#pragma once

#include "pinball/table/field_reader.h"

namespace carom::pinball {

/// "format" and "version": says whether the rest is worth reading.
[[nodiscard]] bool load_format(FieldReader& in);
/// "materials": fills the table and gives their names.
[[nodiscard]] NameIndex load_materials(FieldReader& in, Table& table, LoadErrors& errors);
/// "name", "author", "size", "ball", "physics".
void load_header(FieldReader& in, const NameIndex& materials, Table& table);

} // namespace carom::pinball
