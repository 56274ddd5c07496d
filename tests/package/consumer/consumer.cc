#include <iostream>

#include "emmy/base/build_info.h"

int main() { std::cout << "emmy " << emmy::GetBuildInfo().version << "\n"; }
