#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/figures.h"
#include "app/inputs/session_folders.h"
#include "app/record/record_commands.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/record/read/rig_pages.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/verify/verification.h"

namespace overt {

namespace {

/// What the session stood on. Nothing of records that are damaged, and of those that name no rig.
std::vector<NamedRigPage> rig_pages_in(const std::filesystem::path& session, const Verification& found) {
    if (!found.is_sound())
        return {};
    return rig_pages_of(SessionRecord(session));
}

void print(const std::filesystem::path& session, const Verification& found) {
    for (const Damage& damage : found.damages)
        fmt::print("damaged: {}\n", to_text(damage));
    for (const std::string& note : found.notes)
        fmt::print("note: {}\n", note);
    for (const auto& [sitting, page] : rig_pages_in(session, found))
        fmt::print("page of the rig in sitting {}: {}\n", sitting, page);
    const std::string state = found.state == Verification::State::closed ? ""
                              : found.state == Verification::State::running
                                  ? ", and running"
                                  : ", and open: it was interrupted";
    if (found.is_sound())
        fmt::print("{}: sound{}; {}, {}, {:.1f} MB\n", session.string(), state, counted(found.seals, "seal"),
                   counted(found.files, "file"), 1e-6 * static_cast<double>(found.bytes));
    else
        fmt::print("{}: damaged in {}{}\n", session.string(), counted(found.damages.size(), "place"), state);
}

nlohmann::ordered_json to_json(const std::filesystem::path& session, const Verification& found) {
    auto damages = nlohmann::ordered_json::array();
    for (const Damage& damage : found.damages) {
        nlohmann::ordered_json item{{"file", damage.file}};
        if (!damage.table.empty())
            item["table"] = damage.table;
        if (damage.trial_id)
            item["trial_id"] = *damage.trial_id;
        if (damage.trial)
            item["trial"] = *damage.trial + 1;
        if (damage.attempt)
            item["attempt"] = *damage.attempt;
        if (!damage.row.empty())
            item["row"] = damage.row;
        item["what"] = damage.what;
        damages.push_back(std::move(item));
    }
    auto rig_pages = nlohmann::ordered_json::array();
    for (const auto& [sitting, page] : rig_pages_in(session, found))
        rig_pages.push_back({{"sitting", sitting}, {"page", page}});
    return {
        {"session", session.string()},   {"sound", found.is_sound()}, {"state", name_of(found.state)},
        {"seals", found.seals},          {"files", found.files},      {"bytes", found.bytes},
        {"damages", std::move(damages)}, {"notes", found.notes},      {"rig_pages", std::move(rig_pages)}};
}

/// Each session and the records of its further trackers.
std::vector<std::filesystem::path> all_records(const std::vector<std::filesystem::path>& sessions) {
    std::vector<std::filesystem::path> records;
    for (const std::filesystem::path& session : sessions) {
        records.push_back(session);
        for (const std::string& id : further_trackers_of(session))
            records.push_back(further_record(session, id));
    }
    return records;
}

} // namespace

int run_verify(const VerifyOptions& options) {
    bool is_missing = false, is_damaged = false;
    std::size_t places = 0;
    auto sessions = nlohmann::ordered_json::array();
    for (const std::filesystem::path& session : all_records(sessions_in(options.sessions))) {
        try {
            const Verification found = verify_session(session);
            is_damaged |= !found.is_sound();
            places += found.damages.size();
            if (options.json)
                sessions.push_back(to_json(session, found));
            else
                print(session, found);
        } catch (const InputError& error) {
            is_missing = true;
            fmt::print(stderr, "overt: {}\n", error.what());
        }
    }
    if (options.json) {
        nlohmann::ordered_json json =
            to_json(BenchFigures{at_most("damaged places", static_cast<double>(places), "", 0.0)});
        json["sessions"] = std::move(sessions);
        fmt::print("{}", json_text(json));
    }
    return is_missing ? 2 : is_damaged ? 1 : 0;
}

} // namespace overt
