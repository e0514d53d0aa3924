// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/exchange/connection_facts.h"

namespace pugi {
class xml_node;
}

namespace enfilade {

/// Appends an element of a web page that holds text; `style` is its class, "" for none.
pugi::xml_node AppendWords(pugi::xml_node parent, const char* name, const std::string& style,
                           const std::string& text);

/// The tables of the page with their headings: all views by component and name; the pairs that tie,
/// those with most inliers first; the refused pairs, those that could tie components together
/// first.
void AppendViewTable(const ConnectionFacts& facts, pugi::xml_node parent);
void AppendTieTable(const ConnectionFacts& facts, pugi::xml_node parent);
void AppendRefusalTable(const ConnectionFacts& facts, pugi::xml_node parent);

}  // namespace enfilade
