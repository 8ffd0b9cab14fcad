#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"

namespace overt {

namespace {

void check_when(ProtocolExamination& examination, const ObserverFieldSettings& field,
                const std::string& path) {
    if (field.when == form_at_begin || field.when == form_at_end)
        return;
    const std::vector<BlockSettings>& blocks = examination.protocol.blocks;
    if (field.when.starts_with(form_after_block)) {
        const std::string block = field.when.substr(form_after_block.size());
        if (std::ranges::find(blocks, block, &BlockSettings::id) != blocks.end())
            return;
        std::string known;
        for (const BlockSettings& one : blocks)
            known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", one.id);
        examination.error({path}, fmt::format("there is no block \"{}\"", block),
                          known.empty() ? "the protocol has no [[block]]" : "there are: " + known);
        return;
    }
    examination.error({path}, fmt::format("\"{}\" is no time at which a form is filled in", field.when),
                      "write \"begin\", \"end\", or \"block:\" and the id of a block");
}

void check_observer_fields(ProtocolExamination& examination) {
    const std::vector<ObserverFieldSettings>& fields = examination.protocol.observer_fields;
    std::set<std::string_view> ids;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const ObserverFieldSettings& field = fields[i];
        const auto path = [&](std::string_view key) { return fmt::format("observer_field[{}].{}", i, key); };
        if (!field.id.empty() && !ids.insert(field.id).second)
            examination.error({path("id")}, fmt::format("observer_field \"{}\" is there twice", field.id));
        if (field.kind == FieldKind::choice && field.choices.empty())
            examination.error({path("kind")}, "a choice needs \"choices\"", "add choices = [\"…\", \"…\"]");
        if (field.kind != FieldKind::choice && examination.is_written(path("choices")))
            examination.error({path("choices")}, "\"choices\" are for fields of kind \"choice\"");
        for (const std::string_view key : {"min", "max"})
            if (field.kind != FieldKind::number && examination.is_written(path(key)))
                examination.error({path(key)}, fmt::format("\"{}\" is for fields of kind \"number\"", key));
        if (field.min && field.max && *field.min > *field.max)
            examination.error({path("min"), path("max")}, "\"min\" is larger than \"max\"");
        for (const std::string_view key : {"steps", "ends"})
            if (field.kind != FieldKind::scale && examination.is_written(path(key)))
                examination.error({path(key)}, fmt::format("\"{}\" is for fields of kind \"scale\"", key));
        if (!field.ends.empty() && field.ends.size() != 2)
            examination.error({path("ends")}, "a scale has two ends", "write ends = [\"…\", \"…\"]");
        check_when(examination, field, path("when"));
        std::set<std::string_view> choices;
        for (const std::string& choice : field.choices)
            if (trimmed(choice) != choice || choice.empty() || !choices.insert(choice).second)
                examination.error({path("choices")},
                                  fmt::format("the choice \"{}\" is there twice, is empty, or has white "
                                              "space at an end",
                                              choice));
    }
}

/// Two keys of the operator with the same name, or one that is also an answer.
void check_keys(ProtocolExamination& examination) {
    const OperatorSettings& keys = examination.protocol.operators;
    const std::pair<std::string_view, const std::string*> named[] = {
        {"operator.pause", &keys.pause},   {"operator.recalibrate", &keys.recalibrate},
        {"operator.repeat", &keys.repeat}, {"operator.reject", &keys.reject},
        {"operator.skip", &keys.skip},     {"operator.abort", &keys.abort},
        {"operator.yes", &keys.yes},       {"operator.no", &keys.no}};
    std::map<std::string_view, std::string_view> taken;
    for (const auto& [path, key] : named) {
        const auto [earlier, is_free] = taken.emplace(*key, path);
        if (!is_free)
            examination.error({path, earlier->second},
                              fmt::format("the key \"{}\" is also that of \"{}\"", *key, earlier->second));
    }
    constexpr std::size_t digits = 9;
    if (keys.skip_reasons.size() > digits)
        examination.error({"operator.skip_reasons"}, "there are more reasons than digits to choose them by",
                          "keep to nine");
    const ConsentSettings& consent = examination.protocol.consent;
    if (consent.accept_key == consent.decline_key)
        examination.error({"consent.accept_key", "consent.decline_key"},
                          fmt::format("the key \"{}\" both accepts and declines", consent.accept_key));
}

void check_calibration(ProtocolExamination& examination) {
    const CalibrationKeys& keys = examination.protocol.calibration;
    const auto check_count = [&](const char* key, int points) {
        if (points != 3 && points != 5 && points != 9 && points != 13)
            examination.error({key}, fmt::format("{}: there are layouts of 3, 5, 9 and 13 targets", points));
    };
    check_count("calibration.points", keys.points);
    check_count("calibration.validation_points", keys.validation_points);
    if (keys.model == CalibrationModel::homography && keys.points == 3)
        examination.error({"calibration.points", "calibration.model"},
                          "a homography needs 5 targets or more");
    if (keys.mean_limit_deg > keys.max_limit_deg)
        examination.error({"calibration.mean_limit_deg", "calibration.max_limit_deg"},
                          "the mean error may not be larger than the largest");
}

} // namespace

void check_sitting(ProtocolExamination& examination) {
    check_observer_fields(examination);
    check_keys(examination);
    check_calibration(examination);
    const AnswerSettings& answers = examination.protocol.answers;
    if (answers.bits != 16 && answers.bits != 24)
        examination.error({"answers.bits"}, fmt::format("{} bits: sound is kept in 16 or 24", answers.bits));
    if (answers.record == AnswerUse::none && examination.is_written("answers.device"))
        examination.warning({"answers.device"}, "no answers are recorded: \"record\" is \"none\"");
}

} // namespace overt
