#include "experiment/study/read/point_reader.h"

#include "experiment/record/read/gaze_answer.h"
#include "experiment/record/read/pointed_answer.h"
#include "experiment/study/fixations/trial_presentation.h"

namespace overt {

namespace {

constexpr std::string_view by_mouse = "mouse";

std::optional<PointedAnswer> pointed_in(const OpenSession& open, const TrialRecord& trial,
                                        const FlipHistory& history, const SurfaceLookup* lookup,
                                        const GivenAnswer& given, bool has_ledger) {
    const SessionRecord& record = open.record();
    const SessionHeader& header = record.header();
    const std::optional<GazeOfAnswer> gaze = gaze_of_answer(record, trial, given);
    if (!gaze)
        return pointed_answer(header, trial, history, lookup, given);
    PointedPlace place{.at = gaze->place, .when = gaze->at};
    const auto validation = presentation_of(header, trial, has_ledger, open.validations).validation;
    if (validation)
        place.covariance_px =
            covariance_of_gaze(header.display.screen, gaze->place, Degrees{validation->mean_deg});
    return pointed_answer(header, trial, history, lookup, place);
}

} // namespace

void PointReader::read(const OpenSession& open, int session, const std::string& observer,
                       const TrialRecord& trial, int object, const SurfaceLookup* lookup) {
    const SessionRecord& record = open.record();
    const SessionHeader& header = record.header();
    const std::vector<GivenAnswer>& all = trial.outcome.given;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const GivenAnswer& given = all[i];
        if (given.kind != point_kind || given.is_missed)
            continue;
        const std::optional<TrialLedger> ledger = record.ledger(trial);
        const std::optional<PointedAnswer> pointed =
            pointed_in(open, trial, record.flip_history(trial, ledger), lookup, given, ledger.has_value());
        Read found;
        found.is_in_picture = pointed && pointed->shown;
        found.place = trial.place;
        AnsweredPointRow& row = found.row;
        row.of = {observer, header.tasks[static_cast<std::size_t>(trial.trial.task)].id, given.id, object};
        row.session = session;
        row.trial = trial.trial.index + 1;
        row.by = given.value == pointed_by_gaze || given.value == pointed_by_fixation ? given.value
                                                                                      : std::string(by_mouse);
        if (const auto time = given.response_time())
            row.response_s = to_seconds(*time);
        if (pointed && pointed->surface) {
            row.place = pointed->surface->position;
            row.triangle = pointed->surface->triangle;
            row.part = pointed->surface->part;
            row.barycentric = pointed->surface->barycentric;
            row.part_name = pointed->part;
            if (pointed->footprint)
                row.largest_sd = pointed->footprint->largest_sd;
        }
        const auto [known, is_new] = answers_.try_emplace({session, trial.trial.index, i}, found);
        const bool is_better = found.is_in_picture && !known->second.is_in_picture,
                   is_earlier = found.is_in_picture == known->second.is_in_picture &&
                                found.place < known->second.place;
        if (!is_new && (is_better || is_earlier))
            known->second = std::move(found);
    }
}

std::vector<AnsweredPointRow> PointReader::rows() const {
    std::vector<AnsweredPointRow> rows;
    for (const auto& [key, read] : answers_)
        rows.push_back(read.row);
    return rows;
}

} // namespace overt
