#pragma once

#include "pinball/table/field_reader.h"

namespace carom::pinball {

/// Reads the object "groups". The elements must be there already; they learn their group.
void load_groups(const JsonNode& groups, Table& table, LoadErrors& errors);
/// Reads the object "rules". Elements and groups must be there already.
void load_rules(const JsonNode& rules, Table& table, LoadErrors& errors);
/// Reads "card", the rules as the player reads them, from the table's own object.
void load_card(FieldReader& in, Table& table, LoadErrors& errors);

} // namespace carom::pinball
