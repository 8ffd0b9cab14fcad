/// Goes through a session's chain of seals and finds what is not as it was sealed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace overt {

/// One thing that is not as it was recorded.
struct Damage {
    std::string file; ///< relative to the session's directory
    std::string table = {};
    std::optional<std::int64_t> trial_id = {}; ///< the attempt whose rows they are
    std::optional<int> trial = {};             ///< its place in the order, from 0
    std::optional<int> attempt = {};
    std::string row = {}; ///< by its key, such as "n = 17", where it is one row alone
    std::string what;     ///< a sentence without the above
};

/// The whole of it as a sentence.
std::string to_text(const Damage& damage);

struct SealFindings {
    std::int64_t seals = 0;
    std::string last;               ///< hash
    std::int64_t unsealed_rows = 0; ///< of a trial that was running, and what came after the last seal
    std::vector<Damage> damages;
};

/// Reads all sealed rows. In a session that is closed nothing may be without a seal. The database must not
/// change meanwhile: within a transaction, or while nobody writes. What cannot be read is among the damages.
SealFindings check_seals(const SQLite::Database& database, bool is_closed);

} // namespace overt
