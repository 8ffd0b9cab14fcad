/// Who took part, with what they filled in: the columns of a BIDS dataset's participants.tsv and of the table
/// "participants" of exports as tables.
#pragma once

#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/row_layout.h"

namespace overt {

/// A column by its name: those that BIDS knows have BIDS's meaning and levels, others the form's title.
TableColumn participant_column(const std::string& name, const std::string& title);

/// One session of an observer.
struct ParticipantRow {
    std::string observer; ///< the label
    int session = 1;
    std::vector<RecordedObserverField> fields;

    std::string id() const; ///< as BIDS names participants
    /// What was filled in; empty if the session did not ask.
    std::string value_of(const std::string& field) const;
};
ParticipantRow participant_row(const SessionRecord& record);

/// A row for each of the sessions that are put together: the columns are those of all their forms.
RowLayout<ParticipantRow> participants_layout(const std::vector<ParticipantRow>& rows);

} // namespace overt
