// SPDX-License-Identifier: BSD-3-Clause
// Programs and libraries of lockbox that are loaded when they are asked for, because of all that
// they bring with them; and the data that is installed with them.
#pragma once

#include <filesystem>
#include <string>

namespace lockbox {

/// Path of a component: in the folder `lockbox/VERSION` beside the library that holds the code or
/// data at this address, or, where that is linked into a program, in `../lib/lockbox/VERSION`
/// beside the program.
/// Throws InputError if it is not installed.
std::filesystem::path find_component(const std::string& name, const void* address_in_library);

/// The folder `share/lockbox` of the installation or build tree with the library or program that
/// holds the code or data at this address: in the nearest folder above it that has one. Empty if
/// none has.
std::filesystem::path share_folder(const void* address_in_library);

/// Returns the folder `share/doc/lockbox`, which holds README.md and docs/.
std::filesystem::path documents_folder(const void* address_in_library);

/// A text of messages, whose `docs/NAME.md` becomes the path of the document that is installed; as
/// it is where none is.
std::string with_documents(const std::string& text, const void* address_in_library);

/// Loads a library and returns what it exports under this name. It stays loaded: static objects of
/// VTK and the like do not survive it otherwise. Throws InputError with the loader's reason.
void* find_symbol(const std::filesystem::path& library, const std::string& symbol);

}  // namespace lockbox
