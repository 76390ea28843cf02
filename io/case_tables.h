#pragma once
/// The tables of a case file, key by key by the schema -> CaseDef.

#include "core/model/case_def.h"
#include "io/case_problems.h"
#include "io/case_source.h"
#include "io/toml_tree.h"

namespace hdem
{
/// Write what the document says into `def`; places of all keys go to `source`, what is unknown, wrong or missing to `problems`.
void read_tables(const TomlNode& document, CaseDef& def, CaseSource& source, CaseProblems& problems);
}  // namespace hdem
