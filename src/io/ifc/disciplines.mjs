// The discipline of a product, from its class, from that of its type or from its system.

const CLASSES = {
    architecture: ['CURTAINWALL', 'COVERING', 'DOOR', 'WINDOW', 'FURNISHINGELEMENT', 'FURNITURE',
                   'SYSTEMFURNITUREELEMENT', 'SHADINGDEVICE', 'SPACE', 'TRANSPORTELEMENT', 'DOORSTANDARDCASE',
                   'WINDOWSTANDARDCASE', 'FURNITURESTANDARD', 'DOORSTYLE', 'WINDOWSTYLE'],
    structure: ['BEAM', 'COLUMN', 'BEAMSTANDARDCASE', 'COLUMNSTANDARDCASE', 'MEMBER', 'MEMBERSTANDARDCASE', 'PLATE',
                'PLATESTANDARDCASE', 'FOOTING', 'PILE', 'REINFORCINGBAR', 'REINFORCINGMESH', 'REINFORCINGELEMENT',
                'TENDON', 'TENDONANCHOR', 'TENDONCONDUIT', 'FASTENER', 'MECHANICALFASTENER', 'BEARING', 'DEEPFOUNDATION',
                'CAISSONFOUNDATION'],
    plumbing: ['SANITARYTERMINAL', 'WASTETERMINAL', 'STACKTERMINAL', 'INTERCEPTOR'],
    hvac: ['DUCTSEGMENT', 'DUCTFITTING', 'DUCTSILENCER', 'AIRTERMINAL', 'AIRTERMINALBOX', 'AIRTOAIRHEATRECOVERY',
           'BOILER', 'BURNER', 'CHILLER', 'COIL', 'COMPRESSOR', 'CONDENSER', 'COOLEDBEAM', 'COOLINGTOWER', 'DAMPER',
           'ENGINE', 'EVAPORATIVECOOLER', 'EVAPORATOR', 'FAN', 'FILTER', 'HEATEXCHANGER', 'HUMIDIFIER', 'SPACEHEATER',
           'GASTERMINAL', 'TUBEBUNDLE', 'UNITARYEQUIPMENT', 'UNITARYCONTROLELEMENT'],
    electrical: ['CABLESEGMENT', 'CABLEFITTING', 'CABLECARRIERSEGMENT', 'CABLECARRIERFITTING', 'JUNCTIONBOX',
                 'LAMP', 'LIGHTFIXTURE', 'OUTLET', 'SWITCHINGDEVICE', 'PROTECTIVEDEVICE',
                 'PROTECTIVEDEVICETRIPPINGUNIT', 'TRANSFORMER', 'ELECTRICAPPLIANCE', 'ELECTRICDISTRIBUTIONBOARD',
                 'ELECTRICDISTRIBUTIONPOINT', 'ELECTRICFLOWSTORAGEDEVICE', 'ELECTRICFLOWTREATMENTDEVICE',
                 'ELECTRICGENERATOR', 'ELECTRICHEATER', 'ELECTRICMOTOR', 'ELECTRICTIMECONTROL', 'ELECTRICALELEMENT',
                 'ELECTRICALCIRCUIT', 'MOTORCONNECTION', 'SOLARDEVICE', 'AUDIOVISUALAPPLIANCE',
                 'COMMUNICATIONSAPPLIANCE', 'MOBILETELECOMMUNICATIONSAPPLIANCE'],
    fire: ['FIRESUPPRESSIONTERMINAL', 'ALARM'],
    site: ['SITE', 'GEOGRAPHICELEMENT', 'EARTHWORKSFILL', 'EARTHWORKSELEMENT', 'PAVEMENT', 'KERB', 'COURSE'],
};
// Predefined types of IfcDistributionSystem.
const SYSTEMS = {
    plumbing: ['DOMESTICCOLDWATER', 'DOMESTICHOTWATER', 'DRAINAGE', 'RAINWATER', 'SEWAGE', 'STORMWATER',
               'WASTEWATER', 'WATERSUPPLY', 'GAS', 'VACUUM', 'OIL', 'CHEMICAL', 'DISPOSAL', 'SANITARY', 'VENT'],
    hvac: ['AIRCONDITIONING', 'CHILLEDWATER', 'COMPRESSEDAIR', 'CONDENSERWATER', 'EXHAUST', 'FUEL', 'HEATING',
           'REFRIGERATION', 'VENTILATION'],
    electrical: ['AUDIOVISUAL', 'COMMUNICATION', 'CONTROL', 'DATA', 'EARTHING', 'ELECTRICAL', 'ELECTROACOUSTIC',
                 'LIGHTING', 'LIGHTNINGPROTECTION', 'POWERGENERATION', 'SECURITY', 'SIGNAL', 'TELEPHONE', 'TV'],
    fire: ['FIREPROTECTION'],
};

const inverse = table =>
    new Map(Object.entries(table).flatMap(([discipline, words]) => words.map(word => [word, discipline])));
const OF_CLASS = inverse(CLASSES);
const OF_SYSTEM = inverse(SYSTEMS);
// Classes that serve several disciplines. Their system or their file decides.
const SERVICES = /^(FLOW|ENERGYCONVERSION|DISTRIBUTION|ACTUATOR|CONTROLLER|SENSOR|PIPE|PUMP|VALVE|TANK)/;
const OF_SERVICES = ['plumbing', 'hvac', 'electrical', 'fire'];

/** Returns the word of a class: 'WALL' for 'IfcWall'; of a type, that of its occurrences. */
const wordOf = name => name.toUpperCase().replace(/^IFC/, '').replace(/TYPE$/, '');

/** Returns the discipline that a product states itself, or null. */
function ownDiscipline({classes, wholes, systems}) {
    for (const system of systems)
        if (OF_SYSTEM.has(system))
            return OF_SYSTEM.get(system);
    // A member or a plate of a curtain wall is the architect's.
    if (wholes.some(whole => wordOf(whole) === 'CURTAINWALL'))
        return 'architecture';
    for (const name of classes)
        if (OF_CLASS.has(wordOf(name)))
            return OF_CLASS.get(wordOf(name));
    return null;
}

/**
 * Returns the disciplines of the products of a file. A product without one of its own has the most
 * frequent one of the file; a pipe or a device, the most frequent one of the building services.
 *
 * In: products: {classes: names of the classes of its types and of itself; wholes: names of the
 * classes of what it is a part of; systems: predefined types}.
 */
export function disciplinesOf(products) {
    const own = products.map(ownDiscipline);
    const counts = new Map();
    for (const discipline of own)
        if (discipline !== null)
            counts.set(discipline, (counts.get(discipline) ?? 0) + 1);
    const most = among => among.filter(each => counts.has(each))
                              .reduce((best, each) => best !== null && counts.get(best) >= counts.get(each) ? best : each, null);
    const ofFile = most(Object.keys(CLASSES)) ?? 'architecture';
    const ofServices = most(OF_SERVICES);
    const ofService = words => ofServices ?? (words.some(word => word.startsWith('PIPE')) ? 'plumbing' : 'hvac');
    return own.map((discipline, i) => {
        const words = products[i].classes.map(wordOf);
        return discipline ?? (words.some(word => SERVICES.test(word)) ? ofService(words) : ofFile);
    });
}
