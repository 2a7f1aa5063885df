#pragma once

/// @file
/// Reads what is particular to each type of element.

#include "pinball/table/field_reader.h"

namespace carom::pinball {

struct TypeReader
{
    Part (*read)(FieldReader&);
    bool solid; ///< a ball can touch it, so it needs a material
};

/// The reader of a type, by its place in type_names.
[[nodiscard]] const TypeReader& type_reader(std::size_t type);

} // namespace carom::pinball
