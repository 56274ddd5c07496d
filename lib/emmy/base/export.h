// Marks what a shared library shows to others.
//
// The library is compiled with hidden symbols: functions and classes without
// EMMY_EXPORT are its own affair, may change in any version, and cannot be
// linked to from outside a shared libemmy. emmy/emmy.h lists the headers whose
// functions are marked.

#ifndef EMMY_BASE_EXPORT_H_
#define EMMY_BASE_EXPORT_H_

// Before the name of a class, or before the type of a function.
#define EMMY_EXPORT __attribute__((visibility("default")))

#endif  // EMMY_BASE_EXPORT_H_
