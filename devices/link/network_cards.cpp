#include "devices/link/network_cards.h"

#include <algorithm>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

namespace overt {

std::vector<NetworkCard> network_cards() {
    ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0)
        return {};
    std::vector<NetworkCard> cards;
    const auto take = [&](const ifaddrs& entry, const std::string& address) {
        cards.push_back(
            {entry.ifa_name, address, (entry.ifa_flags & IFF_UP) != 0, (entry.ifa_flags & IFF_RUNNING) != 0});
    };
    for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
        if ((entry->ifa_flags & IFF_LOOPBACK) != 0 || !entry->ifa_addr ||
            entry->ifa_addr->sa_family != AF_INET)
            continue;
        char text[INET_ADDRSTRLEN] = {};
        const auto* address = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr);
        if (::inet_ntop(AF_INET, &address->sin_addr, text, sizeof text))
            take(*entry, text);
    }
    // Cards without an address are listed once, by an entry of another family.
    for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next)
        if ((entry->ifa_flags & IFF_LOOPBACK) == 0 &&
            std::ranges::find(cards, std::string(entry->ifa_name), &NetworkCard::name) == cards.end())
            take(*entry, "");
    ::freeifaddrs(first);
    return cards;
}

} // namespace overt
