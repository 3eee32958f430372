// Prints tools/web/src/studio/state/operations.ts.
#include <cstdio>

#include "tools/posing/typescript.h"

int main() { return std::fputs(retarget::posing::OperationsTypeScript().c_str(), stdout) < 0; }
