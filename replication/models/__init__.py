"""The models: functions of plain floats, one case; `arrays` compiles the same ones for many."""
