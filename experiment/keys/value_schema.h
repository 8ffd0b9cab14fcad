/// JSON Schema of the values of keys: one function for each form that a value has in a file. Only the files
/// of value types include it.
#pragma once

#include <nlohmann/json.hpp>

#include "experiment/keys/key_rule.h"

namespace overt::schema_of {

using Json = nlohmann::ordered_json;

Json truth(const KeyRule& rule);
Json whole(const KeyRule& rule);
Json number(const KeyRule& rule);
Json path(const KeyRule& rule);
Json three(const KeyRule& rule);
Json triples(const KeyRule& rule);
Json spheres(const KeyRule& rule);
Json planes(const KeyRule& rule);
Json named_numbers(const KeyRule& rule);
Json named_shares(const KeyRule& rule);
Json named_words(const KeyRule& rule);
Json series(const KeyRule& rule);
Json numbers(const KeyRule& rule);
Json text(const KeyRule& rule);
Json texts(const KeyRule& rule);

} // namespace overt::schema_of
