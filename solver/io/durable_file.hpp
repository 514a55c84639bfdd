// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Files that are either the old one or the new one, whatever stops the program in between.

#include <filesystem>
#include <string>

namespace scree {

/// `path` with ".tmp" appended: where the new content is written before it takes the name.
std::filesystem::path aside(const std::filesystem::path& path);

/// Gives `temporary` the name `path`, replacing what was there. Throws RunFault.
void take_name(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// As take_name, but content and name are on the disk on return (fsync of file and folder).
void take_name_durably(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Replaces the content of `path` by `text`: written aside, then renamed. Throws RunFault with one
/// sentence; the old content is then still there.
void replace_file(const std::filesystem::path& path, const std::string& text);

/// The sentence for a write that failed with `error` (an errno value; 0 = unknown).
std::string write_failure(const std::filesystem::path& path, int error);

}  // namespace scree
