#include "experiment/study/read/trial_keys.h"

#include <algorithm>
#include <string_view>

namespace overt {

namespace {

RowLayout<TrialRow> columns_of(const SessionHeader& header) {
    const SharedColumns shared(header);
    return shared.has_slots ? presentations_layout(shared, header) : trials_layout(shared, header);
}

} // namespace

TrialKeys::TrialKeys(const SessionRecord& record)
    : messages_(trial_messages(record)), layout_(columns_of(record.header())) {
    if (!messages_.empty())
        layout_.add<TrialRow>(imported_trial_columns(messages_));
    of_session_.push_back({"observer", record.header().schedule.observer.label});
    of_session_.push_back({"session", std::to_string(record.header().session_number)});
    of_session_.push_back({"day", std::to_string(record.header().session_number)});
    for (const RecordedObserverField& field : record.observer_fields())
        of_session_.push_back({field.id, field.value});
}

std::vector<StudyKey> TrialKeys::of(const TrialRecord& trial, const SampleCounts& samples) const {
    TableText text(layout_.table(), TableFormat::tsv);
    layout_.write(text, TrialRow{trial, &samples});
    std::vector<StudyKey> keys;
    std::string_view rest = text.all();
    for (const TableColumn& column : layout_.table().columns) {
        const std::size_t end = rest.find_first_of("\t\n");
        keys.push_back({column.name, std::string(rest.substr(0, end))});
        rest.remove_prefix(std::min(end, rest.size() - 1) + 1);
    }
    for (const StudyKey& key : of_session_) {
        const bool is_there = std::any_of(keys.begin(), keys.end(),
                                          [&](const StudyKey& other) { return other.column == key.column; });
        if (!is_there)
            keys.push_back(key);
    }
    return keys;
}

} // namespace overt
