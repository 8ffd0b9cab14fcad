#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "experiment/protocol/protocol_checks.h"

namespace overt {

void check_observer_fields(ProtocolExamination& examination) {
    const std::vector<ObserverFieldSettings>& fields = examination.protocol.observer_fields;
    std::set<std::string_view> ids;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const ObserverFieldSettings& field = fields[i];
        const auto path = [&](std::string_view key) { return fmt::format("observer_fields[{}].{}", i, key); };
        if (!field.id.empty() && !ids.insert(field.id).second)
            examination.error({path("id")}, fmt::format("observer_fields \"{}\" is there twice", field.id));
        if (field.kind == FieldKind::choice && field.choices.empty())
            examination.error({path("kind")}, "a choice needs \"choices\"", "add choices = [\"…\", \"…\"]");
        if (field.kind != FieldKind::choice && examination.is_written(path("choices")))
            examination.error({path("choices")}, "\"choices\" are for fields of kind \"choice\"");
        for (const std::string_view key : {"min", "max"})
            if (field.kind != FieldKind::number && examination.is_written(path(key)))
                examination.error({path(key)}, fmt::format("\"{}\" is for fields of kind \"number\"", key));
        if (field.min && field.max && *field.min > *field.max)
            examination.error({path("min"), path("max")}, "\"min\" is larger than \"max\"");
        std::set<std::string_view> choices;
        for (const std::string& choice : field.choices)
            if (trimmed(choice) != choice || choice.empty() || !choices.insert(choice).second)
                examination.error({path("choices")},
                                  fmt::format("the choice \"{}\" is there twice, is empty, or has white "
                                              "space at an end",
                                              choice));
    }
}

} // namespace overt
