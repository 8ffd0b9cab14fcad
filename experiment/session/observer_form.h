/// The observer's form while it is filled in on the screen.
#pragma once

#include <span>
#include <string>

#include "experiment/ports/observer_field.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/response_panel.h"
#include "experiment/protocol/sitting_settings.h"

namespace overt {

class ObserverForm {
  public:
    /// `fields` must outlive the form. `given`: what is filled in already.
    /// `words`: what is said below the fields.
    ObserverForm(std::span<const ObserverFieldSettings> fields, FieldValues given, WordSettings words = {});

    /// Takes a key: characters are typed, in a choice they go to the next that begins with them; left and
    /// right choose; up and down (tab) go to other fields; next goes on once there is nothing at fault in
    /// this field, and from the last one submits: what is still at fault anywhere is said and gone to.
    /// Whether the form is submitted.
    bool take(const ResponsePress& press);

    const FieldValues& values() const { return values_; }
    int focus() const { return static_cast<int>(focus_); }
    const std::string& message() const { return message_; } ///< what is at fault, or empty

    /// The form as it is shown: a row for each field, what is at fault or the field's note, and the keys.
    Screen screen() const;

  private:
    const ObserverFieldSettings& field() const { return fields_[focus_]; }
    void type(char32_t character);
    void erase();
    void choose(int step);
    bool submit();
    /// Whether there is one; what is said of it is in message().
    bool says_fault_of(std::size_t index);

    std::span<const ObserverFieldSettings> fields_;
    FieldValues values_;
    WordSettings words_;
    std::size_t focus_ = 0;
    std::string message_;
};

} // namespace overt
