"""The models: functions of plain floats for one case; `arrays` compiles them for many cases."""
