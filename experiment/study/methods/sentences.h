/// What sentences on a study's methods are put together from.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/study/methods/study_facts.h"

namespace overt {

/// "a", "a and b", "a, b and c".
std::string joined_words(std::span<const std::string> words);

/// With capital letter and full stop, and a blank before it if something stands there already. Nothing of an
/// empty clause.
void add_sentence(std::string& text, std::string_view clause);

/// A number that somebody set, as they wrote it; of up to six digits.
std::string as_set(double number);

/// A number that was measured: three significant digits, and no more decimals than say something. What is not
/// 0 and would be written as 0 is "below 0.001".
std::string as_measured(double number, int most_decimals = 3);

/// Whole numbers; "12,345" from four digits on.
std::string as_count(std::int64_t number);

/// "1 trial", "12,345 trials".
std::string as_counted(std::int64_t number, std::string_view one);

/// "0.42 deg (median over 30 trials; 0.31 to 0.55 deg)"; of one trial, or where all are alike, without them.
std::string as_spread(const Spread& spread, std::string_view unit, int most_decimals);

/// "3 of 5 trials": all of them are "all 5 trials", of one "the one trial".
std::string share_of(int part, int all, std::string_view thing);

/// What a clause says of each session, as one sentence if it is the same of all, else one for each clause:
/// "In 2 of 3 sessions, …". Of empty clauses nothing is said.
void add_over_sessions(std::string& text, const StudyResults& results,
                       const std::function<std::string(const StudySession&)>& clause);

} // namespace overt
