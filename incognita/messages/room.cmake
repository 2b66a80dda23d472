incognita_room(messages USES incognita::vision)
