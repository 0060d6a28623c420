// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

namespace lockbox::app {

/// Refuse values of options with a message that says what they must be.
CLI::Validator positive();
CLI::Validator not_negative();
CLI::Validator whole_number();  ///< also as 1e3
CLI::Validator between(double least, double most);
CLI::Validator one_of(const std::vector<std::string>& names);
CLI::Validator suggested(const std::vector<std::string>& names);  ///< refuses nothing
CLI::Validator picture_name();                                    ///< ends in .png
CLI::Validator video_name();                                      ///< ends in .mp4 or .mkv
CLI::Validator table_name();                                      ///< ends in .csv
CLI::Validator recording_name();  ///< ends in .oni, or no source would know it again
CLI::Validator folder_name();     ///< neither that of a file of a known kind nor `-`
CLI::Validator recording_or_folder_name();

/// Refuses what read throws InputError for, with its words.
CLI::Validator readable(const std::function<void(const std::string&)>& read);

/// The names that values of the option must be one of; empty if it is no such option.
std::vector<std::string> choices_of(CLI::Option& option);

/// The same, or names that its values may be one of.
std::vector<std::string> suggestions_of(CLI::Option& option);

/// Declares --threads, of which no more are taken than an Executor takes.
void add_threads_option(CLI::App& options, int& threads);

/// Declares --overwrite; whether files exist is checked by require_new (output_paths.hpp).
void add_overwrite_option(CLI::App& options, bool& overwrite);

}  // namespace lockbox::app
