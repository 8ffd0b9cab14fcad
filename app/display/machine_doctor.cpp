#include "app/display/machine_doctor.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <grp.h>
#include <pwd.h>
#include <sys/resource.h>
#include <unistd.h>

#include "app/cli/own_folders.h"
#include "devices/host/thread_priority.h"

namespace overt {

namespace {

constexpr const char* rule_name = "70-overt.rules";
constexpr const char* limits_file = "/etc/security/limits.d/70-overt.conf";

/// A paper's stimuli and a few sessions.
constexpr double little_disk_gb = 10.0;

double free_gb(const std::filesystem::path& folder) {
    std::filesystem::path existing = folder;
    while (!existing.empty() && !std::filesystem::exists(existing))
        existing = existing.parent_path();
    std::error_code error;
    const auto space = std::filesystem::space(existing, error);
    return error ? 0.0 : static_cast<double>(space.available) / 1e9;
}

DoctorFinding disk_finding(std::string what, const std::filesystem::path& folder) {
    const double gb = free_gb(folder);
    return {std::move(what), fmt::format("{:.1f} GB in {}", gb, folder.string()),
            gb < little_disk_gb ? "make room, or name another folder (--sessions, OVERT_CACHE)" : ""};
}

/// The package's limits are for the members of a group.
std::string limits_remedy() {
    return std::filesystem::exists(limits_file) ? "sudo adduser $USER overt, then log in anew"
                                                : "install the Debian package of overt, or let this user "
                                                  "have rtprio 40 and memlock unlimited in "
                                                  "/etc/security/limits.conf; then log in anew";
}

DoctorFinding priority_finding() {
    // Limits alone do not tell: root needs none, containers take it away, and RealtimeKit gives it.
    const ThreadWish wish = try_realtime_priority();
    return wish.granted ? DoctorFinding{"real-time priority", "granted: " + wish.detail}
                        : DoctorFinding{"real-time priority", "refused: " + wish.detail, limits_remedy()};
}

DoctorFinding memory_finding() {
    rlimit limit{};
    getrlimit(RLIMIT_MEMLOCK, &limit);
    if (limit.rlim_cur == RLIM_INFINITY || geteuid() == 0)
        return {"locked memory", "as much as there is"};
    return {"locked memory", fmt::format("{:.1f} MB", static_cast<double>(limit.rlim_cur) / 1e6),
            limits_remedy()};
}

DoctorFinding serial_finding() {
    const group* const ports = getgrnam("dialout");
    if (!ports || geteuid() == 0)
        return {"serial ports", "may be opened"};
    std::vector<gid_t> mine(static_cast<std::size_t>(std::max(0, getgroups(0, nullptr))));
    const int count = getgroups(static_cast<int>(mine.size()), mine.data());
    mine.resize(static_cast<std::size_t>(std::max(0, count)));
    if (std::ranges::find(mine, ports->gr_gid) != mine.end())
        return {"serial ports", "may be opened: this account is in the group dialout"};
    return {"serial ports",
            "this account is not in the group dialout, which owns those without a rule of udev",
            "sudo adduser $USER dialout, then log in anew"};
}

} // namespace

DoctorFinding udev_finding(const std::vector<std::filesystem::path>& folders) {
    std::error_code error;
    for (const std::filesystem::path& folder : folders)
        if (std::filesystem::exists(folder / rule_name, error))
            return {"rights to devices", (folder / rule_name).string()};
    return {
        "rights to devices",
        "the rule of udev that comes with overt is not installed: response boxes and trackers may be refused",
        fmt::format("sudo cp assets/udev/{} /etc/udev/rules.d/ && sudo udevadm control --reload, then plug "
                    "the devices in anew",
                    rule_name)};
}

std::vector<DoctorFinding> governor_findings(const std::filesystem::path& cpus) {
    std::set<std::string> governors;
    std::error_code error;
    for (const auto& cpu : std::filesystem::directory_iterator(cpus, error)) {
        std::ifstream file(cpu.path() / "cpufreq/scaling_governor");
        if (std::string name; std::getline(file, name) && !name.empty())
            governors.insert(name);
    }
    if (governors.empty())
        return {};
    const bool is_steady = governors == std::set<std::string>{"performance"};
    return {{"processors' governor", fmt::format("{}", fmt::join(governors, ", ")),
             is_steady ? "" : "sudo cpupower frequency-set -g performance"}};
}

std::vector<DoctorFinding> examine_machine() {
    std::vector<DoctorFinding> findings{
        {"processors", fmt::format("{}", std::thread::hardware_concurrency())}};
    for (DoctorFinding& finding : governor_findings("/sys/devices/system/cpu"))
        findings.push_back(std::move(finding));
    findings.push_back(priority_finding());
    findings.push_back(memory_finding());
    findings.push_back(udev_finding(
        {"/etc/udev/rules.d", "/run/udev/rules.d", "/usr/lib/udev/rules.d", "/lib/udev/rules.d"}));
    findings.push_back(serial_finding());
    findings.push_back(disk_finding("free disk, here", std::filesystem::current_path()));
    findings.push_back(disk_finding("free disk, cache", cache_folder()));
    return findings;
}

} // namespace overt
