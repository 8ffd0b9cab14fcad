#include "experiment/checks/rotation_balance.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/checks/design_report.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/rotation.h"

namespace overt {

namespace {

CrossTable cross(const Protocol& protocol, const Rotations& rotations, const RotatedFactor& first,
                 const RotatedFactor& second, const std::vector<int>& rows) {
    CrossTable table{describe(first, protocol), describe(second, protocol),
                     std::vector(static_cast<std::size_t>(first.rows),
                                 std::vector<int>(static_cast<std::size_t>(second.rows)))};
    for (const int row : rows) {
        const int one = rotations.row_of(first.kind, first.block, row) % first.rows;
        const int other = rotations.row_of(second.kind, second.block, row) % second.rows;
        ++table.observers[static_cast<std::size_t>(one)][static_cast<std::size_t>(other)];
    }
    return table;
}

} // namespace

bool CrossTable::is_even() const {
    const int any = observers.front().front();
    return std::all_of(observers.begin(), observers.end(), [&](const std::vector<int>& row) {
        return std::all_of(row.begin(), row.end(), [&](int count) { return count == any; });
    });
}

std::vector<RotationFacts> rotation_facts(const Protocol& protocol) {
    std::map<int, std::vector<int>> rows_by_group;
    for (const Observer& observer : planned_observers(protocol)) {
        const GroupPlace place = group_place(protocol, observer.number);
        rows_by_group[place.group].push_back(place.row);
    }
    std::vector<RotationFacts> all;
    for (const auto& [group, rows] : rows_by_group) {
        const Rotations rotations(protocol, group);
        const std::vector<RotatedFactor>& factors = rotations.factors();
        if (factors.empty())
            continue;
        RotationFacts facts;
        if (group >= 0)
            facts.group = protocol.groups[static_cast<std::size_t>(group)].id;
        facts.observers = static_cast<int>(rows.size());
        facts.period = rotations.period();
        for (std::size_t i = 0; i < factors.size(); ++i) {
            facts.factors.push_back({describe(factors[i], protocol), factors[i].rows});
            for (std::size_t j = i + 1; j < factors.size(); ++j)
                facts.tables.push_back(cross(protocol, rotations, factors[i], factors[j], rows));
        }
        all.push_back(std::move(facts));
    }
    return all;
}

std::vector<std::string> rotation_warnings(const std::vector<RotationFacts>& facts) {
    std::vector<std::string> warnings;
    for (const RotationFacts& group : facts) {
        for (const CrossTable& table : group.tables) {
            if (table.is_even())
                continue;
            int combinations = 0, missing = 0;
            for (const std::vector<int>& row : table.observers) {
                combinations += static_cast<int>(row.size());
                missing += static_cast<int>(std::count(row.begin(), row.end(), 0));
            }
            warnings.push_back(fmt::format(
                "{} and {} cannot be told apart{} with {}: of their {} combinations {}; let the number of "
                "observers be a multiple of {}",
                table.first, table.second,
                group.group.empty() ? std::string() : fmt::format(" in group \"{}\"", group.group),
                counted(group.observers, "observer"), combinations,
                missing > 0 ? fmt::format("{} never come", missing)
                            : std::string("some come more often than others"),
                group.period));
        }
    }
    return warnings;
}

} // namespace overt
