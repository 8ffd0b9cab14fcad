/// Tables and columns of a session file that earlier formats called otherwise.
#pragma once

#include <string>
#include <string_view>

namespace SQLite {
class Database;
}

namespace overt {

/// Sessions of this format and later have today's names.
inline constexpr int first_version_with_todays_names = 4;

/// The name that a table or column has today.
std::string_view todays_name(std::string_view name);
/// The same of each in a list that is separated by ", ".
std::string todays_names(std::string_view list);

/// Lets a file of an earlier format, opened to be read, be asked by today's names: views of this connection
/// alone stand before the tables that were called otherwise or had such columns. The tables themselves are
/// still there as main.NAME. Throws SQLite::Exception.
void show_todays_names(SQLite::Database& database);

/// Renames the tables and columns in the file itself. Values and their order stay, and with them what seals
/// (seal_chain.h) say of them. Throws SQLite::Exception.
void rename_to_today(SQLite::Database& database);

} // namespace overt
