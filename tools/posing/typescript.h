// The operations as types of the studio's page: tools/web/src/studio/state/operations.ts.
#pragma once

#include <string>

namespace retarget::posing {

std::string OperationsTypeScript();

}  // namespace retarget::posing
